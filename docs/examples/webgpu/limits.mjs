// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// What WebGPU can say of a case, and what not.

// Formats whose codes come back from copyTextureToBuffer: bytes of a component, which components, in memory order.
export const COLORS = {
  'rgba8-unorm': { format: 'rgba8unorm', bytes: 1, order: [0, 1, 2, 3] },
  'bgra8-unorm': { format: 'bgra8unorm', bytes: 1, order: [2, 1, 0, 3] },
  'rgba8-srgb': { format: 'rgba8unorm-srgb', bytes: 1, order: [0, 1, 2, 3] },
  'rgb10a2-unorm': { format: 'rgb10a2unorm', bytes: 4, order: [0, 1, 2, 3], packed: [10, 10, 10, 2] },
  'rgba16-float': { format: 'rgba16float', bytes: 2, order: [0, 1, 2, 3] },
  'rg16-float': { format: 'rg16float', bytes: 2, order: [0, 1] },
  'rgba32-float': { format: 'rgba32float', bytes: 4, order: [0, 1, 2, 3] },
  'r32-float': { format: 'r32float', bytes: 4, order: [0] },
  'r32-uint': { format: 'r32uint', bytes: 4, order: [0], whole: true },
  'rgba8-uint': { format: 'rgba8uint', bytes: 1, order: [0, 1, 2, 3], whole: true },
};
export const DEPTHS = { 'd32-float': 'depth32float', 'd16-unorm': 'depth16unorm' };
// Words of 'needs' that WebGPU has nothing for.
const NEVER = {
  blit: 'WebGPU has no blit that scales',
  samples: 'WebGPU has no binary32 targets of several samples',
  'sample-locations': 'WebGPU has no sample locations',
  layers: 'WebGPU has no layer that shaders choose',
  stencil: 'this program draws no stencils',
  fan: 'WebGPU has no triangle fans',
  'bad-numbers': 'WebGPU promises nothing about NaN and infinity',
  'provoking-last': 'WebGPU has no last vertex as provoking one',
  'depth-bias-control': 'WebGPU has no other representation of depth bias',
  'depth-bounds': 'WebGPU has no depth bounds',
  'depth-volume': 'WebGPU has no view volume from -w',
  'cull-distance': 'WebGPU has no cull distances',
  clear: 'WebGPU has no clears among draws',
  instances: 'this program draws one instance',
  'rasterizer-discard': 'WebGPU has no rasterizer discard',
  'conservative-rasterization': 'WebGPU has no conservative rasterization',
  'fragment-size': 'WebGPU has fragments of one pixel',
  'early-tests': 'WebGPU has no early tests',
  'sample-mask': 'this program sets no sample mask',
  'sample-shading': 'WebGPU has no sample shading',
  'viewport-index': 'WebGPU has one viewport',
  barycentrics: 'WebGPU has no barycentric coordinates',
  'sample-inputs': 'this program reads no sample inputs',
  'interpolate-at': 'WebGPU has no interpolation elsewhere',
  'query-lod': 'WebGPU has no textureQueryLod',
  'dual-source-blend': 'this program writes one source of colour',
  'alpha-to-coverage': 'this program does not turn it on',
  'alpha-to-one': 'WebGPU has no alpha to one',
  'logic-operation': 'WebGPU has no logical operations',
};

const isInside = (viewport, most) =>
  viewport.width <= most && viewport.height <= most && Math.min(viewport.x, viewport.y) >= -2 * most &&
  Math.max(viewport.x + viewport.width, viewport.y + viewport.height) <= 2 * most - 1 &&
  viewport.width > 0 && viewport.height > 0 && viewport.min_depth >= 0 && viewport.max_depth <= 1 &&
  viewport.min_depth <= viewport.max_depth;

/** Why the case is left out; empty if it is drawn. */
export function refusal(c, most) {
  for (const need of c.needs) {
    if (NEVER[need] !== undefined) {
      return NEVER[need];
    }
  }
  const { depth, color } = c.target;
  if (Math.max(c.target.width, c.target.height) > most) {
    return `the device has targets of at most ${most} pixels`;
  }
  if (depth !== null && DEPTHS[depth.format] === undefined) {
    return `WebGPU does not say how many bits ${depth.format} has`;
  }
  if (color !== null && COLORS[color.format] === undefined) {
    return `WebGPU has no ${color.format}`;
  }
  for (const draw of c.draws) {
    if (!isInside(draw.viewport, most)) {
      return 'WebGPU has no viewport of negative height or beyond its bounds, and no reversed range of depths';
    }
    if (draw.depth.clamp === draw.depth.clip) {
      return 'WebGPU chooses clamping and clipping together';
    }
    if (draw.topology === 'triangle-list' && draw.primitive_restart) {
      return 'WebGPU restarts strips only';
    }
    if (draw.topology === 'triangle-strip' && draw.indices !== null && !draw.primitive_restart &&
        draw.indices.includes(0xffffffff)) {
      return 'WebGPU always restarts strips';
    }
    if (color !== null && draw.color.blend !== null && /constant-alpha/.test(JSON.stringify(draw.color.blend.color))) {
      return "WebGPU has no factor of the constant's alpha for colours";
    }
    if (draw.cull === 'front-and-back') {
      return 'WebGPU does not cull both faces';
    }
    if (draw.depth.bias !== null && !Number.isInteger(draw.depth.bias.constant)) {
      return 'WebGPU has whole numbers as constant bias';
    }
    if (draw.frag_depth !== null && draw.frag_depth.layout !== 'any') {
      return 'WebGPU has no promise about a written depth';
    }
    if (draw.attributes.some((a) => a.auxiliary === 'sample')) {
      return 'WebGPU shades by the sample where an input asks for it, which is left out here';
    }
  }
  return '';
}
