// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// WGSL of one draw. The vertex shader hands on what the case says, and negates y.

// A binary32 in WGSL, to the bit.
const literal = (v) => {
  const word = new Uint32Array(new Float32Array([v]).buffer)[0];
  return `bitcast<f32>(0x${word.toString(16)}u)`;
};
const PICKED = {
  none: 'false',
  'odd-columns': 'pixel.x % 2 == 1',
  'odd-rows': 'pixel.y % 2 == 1',
  checker: '(pixel.x + pixel.y) % 2 == 1',
  front: 'front',
  back: '!front',
};
const PROBES = {
  value: (x) => x,
  dfdx: (x) => `dpdx(${x})`,
  dfdy: (x) => `dpdy(${x})`,
  fwidth: (x) => `fwidth(${x})`,
  'dfdx-fine': (x) => `dpdxFine(${x})`,
  'dfdy-fine': (x) => `dpdyFine(${x})`,
  'fwidth-fine': (x) => `fwidthFine(${x})`,
  'dfdx-coarse': (x) => `dpdxCoarse(${x})`,
  'dfdy-coarse': (x) => `dpdyCoarse(${x})`,
  'fwidth-coarse': (x) => `fwidthCoarse(${x})`,
};

function interpolation(a) {
  const kind = { smooth: 'perspective', noperspective: 'linear', flat: 'flat, first' }[a.interpolation];
  return a.auxiliary === 'centroid' && a.interpolation !== 'flat' ? `${kind}, centroid` : kind;
}

export function shader(draw, number, attributes, color, hasPrimitives) {
  const clips = draw.clip_distances.count;
  const varyings = draw.attributes.map((a, k) => `@location(${k}) @interpolate(${interpolation(a)}) a${k}: vec4f,`);
  varyings.push('@location(4) @interpolate(flat, first) vertex: u32,');
  const inputs = draw.attributes.map((_, k) => `@location(${1 + k}) v${k}: vec4f,`);
  const outputs = ['@location(0) writer: vec2f,', '@location(1) hits: vec2f,', '@location(2) fragcoord: vec4f,'];
  const writes = [
    `out.writer = vec2f(${number}, f32(${hasPrimitives ? 'primitive' : 'in.vertex'}));`,
    'out.hits = select(vec2f(0, 1), vec2f(1, 0), front);',
    'out.fragcoord = in.position;',
  ];
  draw.attributes.forEach((a, k) => {
    outputs.push(`@location(${3 + k}) o${k}: vec4f,`);
    writes.push(`out.o${k} = ${PROBES[a.probe](`in.a${k}`)};`);
  });
  if (color !== null) {
    const type = color.whole ? 'vec4u' : 'vec4f';
    outputs.push(`@location(${3 + attributes}) color: ${type},`);
    const value = draw.color.value.map((v) => (color.whole ? `${v}u` : literal(v))).join(', ');
    const from = draw.color.attribute === null ? value : `in.a${draw.color.attribute}`;
    writes.push(`out.color = ${type}(${from});`);
  }
  if (draw.frag_depth !== null) {
    const { coord, value, other, where } = draw.frag_depth;
    outputs.push('@builtin(frag_depth) depth: f32,');
    const chosen = `select(${literal(value)}, ${literal(other)}, ${PICKED[where]})`;
    writes.push(`out.depth = ${coord ? 'in.position.z' : chosen};`);
  }
  if (draw.discard !== 'none') { // at the end, so that derivatives see every fragment
    const condition = draw.discard === 'negative' ? `in.a${draw.discard_attribute}.x < 0` : PICKED[draw.discard];
    writes.push(`if (${condition}) { discard; }`);
  }
  const clipIn = clips > 0 ? '@location(5) clips: vec4f' : '';
  const clipOut = clips > 0 ? `@builtin(clip_distances) clips: array<f32, ${clips}>,` : '';
  const primitive = hasPrimitives ? '@builtin(primitive_index) primitive: u32' : '';
  return `${hasPrimitives ? 'enable primitive_index;' : ''}
${clips > 0 ? 'enable clip_distances;' : ''}
struct Between { @builtin(position) position: vec4f, ${varyings.join(' ')} }
struct Vertex { @builtin(position) position: vec4f, ${clipOut} ${varyings.join(' ')} }
@vertex fn vertex(@builtin(vertex_index) vertex: u32, @location(0) position: vec4f,
                  ${inputs.join(' ')} ${clipIn}) -> Vertex {
  var out: Vertex;
  out.position = vec4f(position.x, -position.y, position.zw);
  ${draw.attributes.map((_, k) => `out.a${k} = v${k};`).join(' ')}
  ${[...Array(clips).keys()].map((k) => `out.clips[${k}] = clips[${k}];`).join(' ')}
  out.vertex = vertex;
  return out;
}
struct Out { ${outputs.join(' ')} }
@fragment fn fragment(in: Between, @builtin(front_facing) front: bool, ${primitive}) -> Out {
  var out: Out;
  let pixel = vec2u(in.position.xy);
  ${writes.join('\n  ')}
  return out;
}`;
}
