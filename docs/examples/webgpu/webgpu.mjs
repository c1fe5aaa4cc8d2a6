// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws exported cases with WebGPU, for 'edgecase diff': Dawn in Node.js, on any Vulkan driver that Dawn takes.
//
//     npm install webgpu
//     usage: node webgpu.mjs EXPORT CAPTURES [--half-pixel]
//
// A case goes into one render pass with an attachment for each plane. WebGPU draws binary32 targets with one sample a
// pixel only, and says less than Vulkan does; what it cannot say is left out with its reason. Its y points upwards in
// clip space, so the vertex shader negates y; rows begin at the top as in a case file, and a face that is clockwise on
// screen is 'cw'. --half-pixel moves all viewports by half a pixel, so that something is wrong.
import fs from 'node:fs';
import path from 'node:path';

import { COLORS, DEPTHS, refusal } from './limits.mjs';
import { shader } from './shader.mjs';

const fail = (sentence) => {
  process.stderr.write(`error: ${sentence}\n`);
  process.exit(1);
};

const COMPARE = { 'less-or-equal': 'less-equal', 'greater-or-equal': 'greater-equal' };
const compare = (word) => COMPARE[word] ?? word;
const factor = (word) =>
  word.replace('-color', '').replace('constant-alpha', 'constant').replace('src-alpha-saturate', 'src-alpha-saturated');

// Draws and provoking vertices become draws and triangles; null where two triangles of a draw share a vertex.
function trianglesOf(c, writers) {
  if (c.draws.some((d) => new Set(d.provoking_vertices).size < d.provoking_vertices.length)) {
    return null;
  }
  const numbers = c.draws.map((d) => new Map(d.provoking_vertices.map((v, k) => [v, k])));
  return writers.map((v, k) => (k % 2 === 0 || v < 0 ? v : numbers[writers[k - 1]].get(v) ?? 0xffffff));
}

class Renderer {
  constructor(device, hasPrimitives) {
    this.device = device;
    this.hasPrimitives = hasPrimitives;
  }

  texture(format, { width, height }) {
    const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
    return this.device.createTexture({ size: [width, height], format, usage });
  }

  buffer(array, usage) {
    const size = Math.max(array.byteLength, 4);
    const buffer = this.device.createBuffer({ size, usage: usage | GPUBufferUsage.COPY_DST });
    this.device.queue.writeBuffer(buffer, 0, array);
    return buffer;
  }

  vectors(list) {
    const values = list.flatMap((v) => [0, 1, 2, 3].map((k) => v[k] ?? 0));
    return this.buffer(new Float32Array(values), GPUBufferUsage.VERTEX);
  }

  pipeline(c, draw, number, attributes, targets, color) {
    const code = shader(draw, number, attributes, color, this.hasPrimitives);
    const module = this.device.createShaderModule({ code });
    const hasDepth = c.target.depth !== null;
    const inputs = [0, ...draw.attributes.map((_, k) => 1 + k), ...(draw.clip_distances.count > 0 ? [5] : [])];
    const outputs = targets.map((format, k) => ({
      format,
      writeMask: k < 3 + draw.attributes.length || k === 3 + attributes ? 0xf : 0,
    }));
    const add = { srcFactor: 'one', dstFactor: 'one', operation: 'add' };
    outputs[1].blend = { color: add, alpha: add };
    if (color !== null) {
      const { blend, write_mask: writeMask } = draw.color;
      const part = (p) => ({ srcFactor: factor(p.source), dstFactor: factor(p.destination), operation: p.op });
      const plain = (p) => (['min', 'max'].includes(p.operation) ? { ...p, srcFactor: 'one', dstFactor: 'one' } : p);
      outputs[3 + attributes].writeMask = writeMask;
      if (blend !== null) {
        outputs[3 + attributes].blend = { color: plain(part(blend.color)), alpha: plain(part(blend.alpha)) };
      }
    }
    const bias = draw.depth.bias ?? { constant: 0, slope: 0, clamp: 0 };
    const isStrip = draw.topology === 'triangle-strip';
    return this.device.createRenderPipeline({
      layout: 'auto',
      vertex: {
        module,
        buffers: inputs.map((shaderLocation) => ({
          arrayStride: 16,
          attributes: [{ shaderLocation, offset: 0, format: 'float32x4' }],
        })),
      },
      primitive: {
        topology: draw.topology,
        frontFace: draw.front_face === 'clockwise' ? 'cw' : 'ccw',
        cullMode: draw.cull,
        unclippedDepth: draw.depth.clamp,
        ...(isStrip && draw.indices !== null ? { stripIndexFormat: 'uint32' } : {}),
      },
      fragment: { module, targets: outputs },
      ...(hasDepth ? {
        depthStencil: {
          format: DEPTHS[c.target.depth.format],
          depthCompare: compare(draw.depth.compare),
          depthWriteEnabled: draw.depth.write,
          depthBias: bias.constant,
          depthBiasSlopeScale: bias.slope,
          depthBiasClamp: bias.clamp,
        },
      } : {}),
    });
  }

  draw(pass, c, draw, halfPixel) {
    const { viewport: v, scissor: s } = draw;
    const { width, height } = c.target;
    pass.setViewport(v.x + (halfPixel ? 0.5 : 0), v.y, v.width, v.height, v.min_depth, v.max_depth);
    // A scissor must lie in the target: what is cut off holds no pixel.
    const [x0, y0] = [Math.min(Math.max(s.x, 0), width), Math.min(Math.max(s.y, 0), height)];
    const [x1, y1] = [Math.max(Math.min(s.x + s.width, width), x0), Math.max(Math.min(s.y + s.height, height), y0)];
    pass.setScissorRect(x0, y0, x1 - x0, y1 - y0);
    if (c.target.color !== null && draw.color.blend !== null) {
      pass.setBlendConstant(draw.color.blend.constants);
    }
    const lists = [draw.positions, ...draw.attributes.map((a) => a.values)];
    if (draw.clip_distances.count > 0) {
      lists.push(draw.clip_distances.values);
    }
    lists.forEach((list, k) => pass.setVertexBuffer(k, this.vectors(list)));
    if (draw.indices === null) {
      pass.draw(draw.positions.length);
    } else {
      pass.setIndexBuffer(this.buffer(new Uint32Array(draw.indices), GPUBufferUsage.INDEX), 'uint32');
      pass.drawIndexed(draw.indices.length);
    }
  }

  /** The bytes of a texture, row after row. */
  async read(texture, { width, height }, bytes, aspect = 'all') {
    const bytesPerRow = Math.ceil((width * bytes) / 256) * 256;
    const usage = GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ;
    const buffer = this.device.createBuffer({ size: bytesPerRow * height, usage });
    const encoder = this.device.createCommandEncoder();
    encoder.copyTextureToBuffer({ texture, aspect }, { buffer, bytesPerRow }, [width, height]);
    this.device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const rows = new Uint8Array(buffer.getMappedRange());
    const out = new Uint8Array(width * height * bytes);
    for (let y = 0; y < height; ++y) {
      out.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + width * bytes), y * width * bytes);
    }
    buffer.destroy();
    return out;
  }

  async codes(texture, target, color) {
    const { bytes, order, packed } = color;
    const size = packed ? 4 : bytes * order.length;
    const raw = new DataView((await this.read(texture, target, size)).buffer);
    const out = new Uint32Array(4 * target.width * target.height);
    const readers = { 1: 'getUint8', 2: 'getUint16', 4: 'getUint32' };
    const one = (at) => raw[readers[bytes]](at, true);
    for (let k = 0; k < out.length / 4; ++k) {
      if (packed) {
        let word = one(4 * k);
        packed.forEach((bits, i) => {
          out[4 * k + i] = word & ((1 << bits) - 1);
          word >>>= bits;
        });
      } else {
        order.forEach((component, i) => {
          out[4 * k + component] = one(size * k + bytes * i);
        });
      }
    }
    return out;
  }

  /** The planes of a case, by the names of their files. */
  async planes(c, halfPixel) {
    const { target } = c;
    const specs = Object.fromEntries(c.captures.planes.map((p) => [p.name, p]));
    const attributes = Object.keys(specs).filter((name) => name.startsWith('attribute')).length;
    const color = target.color === null ? null : COLORS[target.color.format];
    const values = Array(1 + attributes).fill('rgba32float');
    const formats = ['rg32float', 'rg32float', ...values, ...(color ? [color.format] : [])];
    const clearValue = (k) => (k === 0 ? [-1, -1, 0, 0]
      : k === 1 ? [0, 0, 0, 0]
        : k < 3 + attributes ? Array(4).fill(clear) : target.color.clear);
    const clear = specs.fragcoord.clear;
    const textures = formats.map((format) => this.texture(format, target));
    const depth = target.depth === null ? null : this.texture(DEPTHS[target.depth.format], target);
    const encoder = this.device.createCommandEncoder();
    const pass = encoder.beginRenderPass({
      colorAttachments: textures.map((texture, k) => ({
        view: texture.createView(),
        loadOp: 'clear',
        storeOp: 'store',
        clearValue: clearValue(k),
      })),
      ...(depth === null ? {} : {
        depthStencilAttachment: {
          view: depth.createView(),
          depthLoadOp: 'clear',
          depthStoreOp: 'store',
          depthClearValue: target.depth.clear,
        },
      }),
    });
    c.draws.forEach((draw, number) => {
      pass.setPipeline(this.pipeline(c, draw, number, attributes, formats, color));
      this.draw(pass, c, draw, halfPixel);
    });
    pass.end();
    this.device.queue.submit([encoder.finish()]);
    const floats = async (k, channels) => {
      const all = new Float32Array((await this.read(textures[k], target, k < 2 ? 8 : 16)).buffer);
      return k < 2 ? all : all.filter((_, i) => i % 4 < channels);
    };
    const out = { 'writer.f32': await floats(0), 'hits.f32': await floats(1), 'fragcoord.f32': await floats(2, 4) };
    if (!this.hasPrimitives) {
      const writers = trianglesOf(c, out['writer.f32']);
      delete out['writer.f32'];
      Object.assign(out, writers === null ? {} : { 'writer.f32': writers });
    }
    for (let a = 0; a < attributes; ++a) {
      out[`attribute${a}.f32`] = await floats(3 + a, specs[`attribute${a}`].channels.length);
    }
    if (depth !== null) {
      const isFloat = target.depth.format === 'd32-float';
      const raw = (await this.read(depth, target, isFloat ? 4 : 2, 'depth-only')).buffer;
      out['depth.f32'] = isFloat ? new Float32Array(raw) : Float32Array.from(new Uint16Array(raw), (v) => v / 65535);
    }
    if (color !== null) {
      out['color.u32'] = await this.codes(textures.at(-1), target, color);
    }
    [...textures, ...(depth === null ? [] : [depth])].forEach((t) => t.destroy());
    return out;
  }
}

async function main(words) {
  const folders = words.filter((w) => !w.startsWith('--'));
  const halfPixel = words.includes('--half-pixel');
  if (folders.length !== 2 || words.some((w) => w.startsWith('--') && w !== '--half-pixel')) {
    process.stderr.write('usage: webgpu.mjs EXPORT CAPTURES [--half-pixel]\n');
    process.exit(2);
  }
  const [from, to] = folders;
  const dawn = await import('webgpu').catch(
    () => fail("Node.js finds no package 'webgpu'; run 'npm install webgpu' in the folder of this file or above it"));
  Object.assign(globalThis, dawn.globals);
  globalThis.gpu = dawn.create(['backend=vulkan']);  // kept: devices die with it
  const adapter = await globalThis.gpu.requestAdapter();
  if (adapter === null) {
    fail('Dawn takes no Vulkan driver that it finds');
  }
  // Without primitive_index triangles are told by their provoking vertices, where no two share one.
  const hasPrimitives = adapter.features.has('primitive-index');
  const requiredFeatures = ['float32-blendable', 'clip-distances', 'depth-clip-control'];
  const lacking = requiredFeatures.filter((f) => !adapter.features.has(f));
  if (lacking.length > 0) {
    fail(`this device of WebGPU lacks ${lacking.join(', ')}`);
  }
  if (hasPrimitives) {
    requiredFeatures.push('primitive-index');
  }
  const { maxColorAttachmentBytesPerSample, maxTextureDimension2D } = adapter.limits;
  const requiredLimits = { maxColorAttachmentBytesPerSample, maxTextureDimension2D };
  const device = await adapter.requestDevice({ requiredFeatures, requiredLimits });
  console.log(`${adapter.info.description || adapter.info.device}, WebGPU`);
  const renderer = new Renderer(device, hasPrimitives);
  const leftOut = new Map();
  let [drawn, failed] = [0, 0];
  for (const entry of JSON.parse(fs.readFileSync(path.join(from, 'index.json'))).cases) {
    const folder = path.join(to, entry.folder);
    fs.mkdirSync(folder, { recursive: true });
    const c = JSON.parse(fs.readFileSync(path.join(from, entry.file)));
    const reason = refusal(c, maxTextureDimension2D);
    if (reason !== '') {
      fs.writeFileSync(path.join(folder, 'unsupported.txt'), `${reason}\n`);
      leftOut.set(reason, (leftOut.get(reason) ?? 0) + 1);
      continue;
    }
    device.pushErrorScope('validation');
    const planes = await renderer.planes(c, halfPixel).catch((thrown) => ({ thrown }));
    const error = (await device.popErrorScope()) ?? planes.thrown;
    if (error) { // without planes the case is 'not run', never a pass
      process.stderr.write(`error: ${entry.id}: ${error.message}\n`);
      fs.rmSync(folder, { recursive: true });
      ++failed;
      continue;
    }
    for (const [name, plane] of Object.entries(planes)) {
      fs.writeFileSync(path.join(folder, name), plane);
    }
    ++drawn;
  }
  console.log(`${drawn} cases drawn`);
  [...leftOut].sort().forEach(([reason, count]) => console.log(`${count} left out: ${reason}`));
  process.exit(failed === 0 ? 0 : 1);
}

await main(process.argv.slice(2));
