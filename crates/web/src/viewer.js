// Draws the scene of this page with WebGPU: the shaders, textures and meshes that stand in it, and nothing from elsewhere.
// Drag turns the view, the wheel comes closer, sliders set the materials' parameters.
//
// For programs: `#pixels&size=WxH&samples=N` draws one picture with N x N samples a pixel and writes its bytes (RGBA,
// base64) into an element with the id `pixels` instead.
"use strict";

const scene = JSON.parse(document.getElementById("scene").textContent);
const canvas = document.getElementById("view");
const options = new URLSearchParams(location.hash.slice(1));

const add = (a, b) => a.map((x, i) => x + b[i]);
const scaled = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.sqrt(dot(a, a));
const unit = (a) => scaled(a, 1 / length(a));

/** Turns a vector about a unit axis (Rodrigues). */
function turned(a, axis, angle) {
  const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
  return add(add(scaled(a, cos), scaled(cross(axis, a), sin)), scaled(axis, dot(axis, a) * (1 - cos)));
}

const camera = { offset: add(scene.camera.position, scaled(scene.camera.target, -1)), ...scene.camera };

function orbit(dx, dy) {
  const up = unit(camera.up);
  camera.offset = turned(camera.offset, up, -dx);
  const right = unit(cross(up, camera.offset));
  // The view stops 1 degree short of the poles, where left and right would change places.
  const from = Math.acos(Math.min(1, Math.max(-1, dot(unit(camera.offset), up))));
  const to = Math.min(Math.PI - 0.0175, Math.max(0.0175, from - dy));
  camera.offset = turned(camera.offset, right, to - from);
}

/** What the camera sees, as the renderers of Halfvector have it: depth 1 at the near plane, 0 at infinity. */
function view(aspect) {
  const position = add(camera.target, camera.offset);
  const forward = unit(scaled(camera.offset, -1));
  let right = cross(forward, camera.up);
  if (length(right) === 0) right = cross(forward, [0, 0, 1]);
  if (length(right) === 0) right = [1, 0, 0];
  right = unit(right);
  const up = cross(right, forward);
  const halfHeight = Math.tan((camera.fov * Math.PI) / 360);
  const half = [halfHeight * aspect, halfHeight];
  let [nearest, farthest] = [Infinity, 0];
  for (const corner of scene.corners) {
    const depth = dot(add(corner, scaled(position, -1)), forward);
    [nearest, farthest] = [Math.min(nearest, depth), Math.max(farthest, depth)];
  }
  const near = scene.corners.length === 0 ? 0.01 : Math.max(0.5 * nearest, 1e-4 * farthest, 1e-18);
  const rows = [
    [...scaled(right, 1 / half[0]), -dot(right, position) / half[0]],
    [...scaled(up, 1 / half[1]), -dot(up, position) / half[1]],
    [0, 0, 0, near],
    [...forward, -dot(forward, position)],
  ];
  const clipFromWorld = [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
  const back = scaled(forward, -1);
  const axes = [right, up, back].map((axis) => [...axis, -dot(axis, position)]);
  const viewFromWorld = [0, 1, 2, 3].flatMap((column) => [...axes.map((row) => row[column]), column === 3 ? 1 : 0]);
  return { position, forward, right, up, half, clipFromWorld, viewFromWorld };
}

/** The bytes of a blob: base64 of zlib. */
async function inflated(text) {
  const coded = atob(text);
  const bytes = new Uint8Array(coded.length);
  for (let i = 0; i < coded.length; i++) bytes[i] = coded.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The bytes of half floats from what they differ from left + above - left above, each channel of a level by itself. */
function undifferenced(bytes, levels, layers, channels) {
  const count = bytes.length / 2;
  const halves = new Uint16Array(count);
  let first = 0;
  let next = 0;
  for (const [width, height] of levels) {
    const row = width * channels;
    for (let channel = 0; channel < channels; channel++) {
      for (let y = 0; y < layers * height; y++) {
        const above = y % height > 0 ? row : 0;
        for (let x = 0; x < width; x++, next++) {
          const code = (bytes[next] << 8) | bytes[count + next];
          const i = first + y * row + x * channels + channel;
          let value = (code >> 1) ^ -(code & 1);
          if (x > 0) value += halves[i - channels];
          if (above) value += halves[i - above];
          if (x > 0 && above) value -= halves[i - above - channels];
          halves[i] = value;
        }
      }
    }
    first += layers * height * row;
  }
  return new Uint8Array(halves.buffer);
}

function show(message) {
  document.getElementById("message").textContent = message;
}

async function openDevice() {
  const help = "This page needs WebGPU, which this browser or this machine does not offer. A current Chrome, Edge, " +
    "Firefox or Safari with a graphics driver does.";
  if (!navigator.gpu) throw new Error(help);
  const adapter = await navigator.gpu.requestAdapter();
  if (!adapter) throw new Error(help);
  const wanted = ["maxSampledTexturesPerShaderStage", "maxSamplersPerShaderStage", "maxBufferSize", "maxTextureDimension2D"];
  const requiredLimits = Object.fromEntries(wanted.map((name) => [name, adapter.limits[name]]));
  const device = await adapter.requestDevice({ requiredLimits });
  device.lost.then((info) => show(`The graphics device was lost: ${info.message}. Load the page again.`));
  return { device, software: adapter.info.isFallbackAdapter === true };
}

async function prepare({ device, software }) {
  const filled = (bytes, usage) => {
    const buffer = device.createBuffer({ size: Math.max(bytes.byteLength, 16), usage: usage | GPUBufferUsage.COPY_DST });
    device.queue.writeBuffer(buffer, 0, bytes);
    return buffer;
  };
  const uniform = async (blob) => {
    const bytes = await inflated(blob);
    return { bytes, buffer: filled(bytes, GPUBufferUsage.UNIFORM) };
  };

  const textures = [];
  for (const { format, texel, layers, levels, halves, blob } of scene.textures) {
    const coded = await inflated(blob);
    const bytes = halves > 0 ? undifferenced(coded, levels, layers, halves) : coded;
    const [width, height] = levels[0];
    const texture = device.createTexture({
      size: [width, height, layers], format, mipLevelCount: levels.length,
      usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    let offset = 0;
    levels.forEach(([width, height], mipLevel) => {
      const layout = { offset, bytesPerRow: width * texel, rowsPerImage: height };
      device.queue.writeTexture({ texture, mipLevel }, bytes, layout, [width, height, layers]);
      offset += width * height * layers * texel;
    });
    textures.push(texture.createView({ dimension: layers === 6 ? "cube" : "2d" }));
  }

  const meshes = [];
  for (const mesh of scene.meshes) {
    const attributes = {};
    for (const [name, blob] of Object.entries(mesh.attributes)) {
      attributes[name] = filled(await inflated(blob), GPUBufferUsage.VERTEX);
    }
    meshes.push({ attributes, indices: filled(await inflated(mesh.indices), GPUBufferUsage.INDEX), count: mesh.count });
  }

  const layoutOf = ({ kind, view, vertex, fragment, binding }) => ({
    binding,
    visibility: (vertex ? GPUShaderStage.VERTEX : 0) | (fragment ? GPUShaderStage.FRAGMENT : 0),
    ...(kind === "uniform" ? { buffer: {} } : kind === "texture" ? { texture: { viewDimension: view } } : { sampler: {} }),
  });
  const materials = [];
  for (const material of scene.materials) {
    const blocks = [];
    const groups = [];
    for (const bindings of material.groups) {
      const layout = device.createBindGroupLayout({ entries: bindings.map(layoutOf) });
      const bind = async (ofObject) => {
        const entries = [];
        for (const entry of bindings) {
          let resource;
          if (entry.kind === "uniform") {
            const block = { ...(await uniform(ofObject?.[entry.name] ?? entry.blob)), members: entry.members };
            blocks.push(block);
            resource = { buffer: block.buffer };
          } else {
            resource = entry.kind === "texture" ? textures[entry.texture] : device.createSampler(entry.sampler);
          }
          entries.push({ binding: entry.binding, resource });
        }
        return device.createBindGroup({ layout, entries });
      };
      groups.push({ layout, bind });
    }
    const module = device.createShaderModule({ code: material.wgsl });
    const layout = device.createPipelineLayout({ bindGroupLayouts: groups.map((group) => group.layout) });
    const shared = [await groups[0].bind(), await groups[1].bind()];
    const pipelines = new Map();
    const pipeline = ({ mirrored, cull, blend }) => {
      const key = `${mirrored} ${cull} ${blend}`;
      const premultiplied = { srcFactor: "one", dstFactor: "one-minus-src-alpha" };
      if (!pipelines.has(key)) {
        pipelines.set(key, device.createRenderPipeline({
          layout,
          vertex: {
            module,
            buffers: material.vertexInputs.map(({ location, format, stride }) => (
              { arrayStride: stride, attributes: [{ shaderLocation: location, format, offset: 0 }] })),
          },
          fragment: {
            module,
            targets: [{ format: "rgba16float", ...(blend && { blend: { color: premultiplied, alpha: premultiplied } }) }],
          },
          primitive: { topology: "triangle-list", frontFace: mirrored ? "cw" : "ccw", cullMode: cull },
          depthStencil: { format: "depth32float", depthWriteEnabled: !blend, depthCompare: "greater" },
        }));
      }
      return pipelines.get(key);
    };
    materials.push({ blocks, shared, pipeline, object: groups[2].bind, inputs: material.vertexInputs });
  }

  const draws = [];
  for (const { object, ...pass } of scene.passes) {
    const { mesh, material, uniforms, middle } = scene.objects[object];
    const [shape, of] = [meshes[mesh], materials[material]];
    draws.push({
      blend: pass.blend, middle, indices: shape.indices, count: shape.count, pipeline: of.pipeline(pass),
      groups: [...of.shared, await of.object(uniforms)], buffers: of.inputs.map((input) => shape.attributes[input.name]),
    });
  }

  let sky = null;
  if (scene.sky) {
    const module = device.createShaderModule({ code: scene.sky.wgsl });
    const pipeline = device.createRenderPipeline({
      layout: "auto", vertex: { module }, fragment: { module, targets: [{ format: "rgba16float" }] },
      depthStencil: { format: "depth32float", depthWriteEnabled: false, depthCompare: "greater-equal" },
    });
    const buffer = filled(new Float32Array(16), GPUBufferUsage.UNIFORM);
    const entries = [{ buffer }, textures[scene.sky.radiance], device.createSampler(scene.sky.sampler)];
    sky = { pipeline, buffer, group: device.createBindGroup({
      layout: pipeline.getBindGroupLayout(0), entries: entries.map((resource, binding) => ({ binding, resource })),
    }) };
  }
  const display = { module: device.createShaderModule({ code: scene.display.wgsl }), pipelines: new Map(),
    buffer: filled(new Float32Array(4), GPUBufferUsage.UNIFORM) };
  return { device, software, materials, draws, sky, display, target: null };
}

/** Sets the members that this source fills, in all blocks of all materials. */
function setSource(gpu, source, numbers, materials = gpu.materials) {
  for (const block of materials.flatMap((material) => material.blocks)) {
    for (const member of block.members.filter((member) => member.source === source)) {
      const Numbers = member.integer ? Int32Array : Float32Array;
      new Numbers(block.bytes.buffer, member.offset, numbers.length).set(numbers);
      gpu.device.queue.writeBuffer(block.buffer, 0, block.bytes);
    }
  }
}

/** Draws a frame of so many pixels into a texture. */
function draw(gpu, output, width, height, side) {
  const { device, display, sky } = gpu;
  const seen = view(width / height);
  setSource(gpu, "clip_from_world", seen.clipFromWorld);
  setSource(gpu, "camera_position", seen.position);
  setSource(gpu, "view_from_world", seen.viewFromWorld);
  setSource(gpu, "time", [scene.time]);
  if (sky) {
    const [right, up] = [scaled(seen.right, seen.half[0]), scaled(seen.up, seen.half[1])];
    const numbers = [...right, 0, ...up, 0, ...seen.forward, 0, ...scene.sky.rotation, scene.display.coded, 0];
    device.queue.writeBuffer(sky.buffer, 0, new Float32Array(numbers));
  }
  const shown = new ArrayBuffer(16);
  new Float32Array(shown)[0] = scene.display.exposure;
  new Int32Array(shown, 4, 2).set([side, scene.display.coded]);
  device.queue.writeBuffer(display.buffer, 0, shown);

  const size = [width * side, height * side];
  if (!gpu.target || gpu.target.size.join() !== size.join()) {
    gpu.target?.textures.forEach((texture) => texture.destroy());
    const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.TEXTURE_BINDING;
    const textures = ["rgba16float", "depth32float"].map((format) => device.createTexture({ size, format, usage }));
    gpu.target = { size, textures, views: textures.map((texture) => texture.createView()) };
  }
  const [color, depth] = gpu.target.views;
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginRenderPass({
    colorAttachments: [{ view: color, clearValue: scene.clear, loadOp: "clear", storeOp: "store" }],
    depthStencilAttachment: { view: depth, depthClearValue: 0, depthLoadOp: "clear", depthStoreOp: "discard" },
  });
  const drawOne = ({ pipeline, groups, buffers, indices, count }) => {
    pass.setPipeline(pipeline);
    groups.forEach((group, index) => pass.setBindGroup(index, group));
    buffers.forEach((buffer, slot) => pass.setVertexBuffer(slot, buffer));
    pass.setIndexBuffer(indices, "uint32");
    pass.drawIndexed(count);
  };
  gpu.draws.filter((it) => !it.blend).forEach(drawOne);
  if (sky) {
    pass.setPipeline(sky.pipeline);
    pass.setBindGroup(0, sky.group);
    pass.draw(3);
  }
  const far = (it) => dot(it.middle, seen.forward);
  gpu.draws.filter((it) => it.blend).sort((a, b) => far(b) - far(a)).forEach(drawOne);
  pass.end();

  if (!display.pipelines.has(output.format)) {
    const { module } = display;
    const targets = [{ format: output.format }];
    const pipeline = device.createRenderPipeline({ layout: "auto", vertex: { module }, fragment: { module, targets } });
    display.pipelines.set(output.format, pipeline);
  }
  const pipeline = display.pipelines.get(output.format);
  const last = encoder.beginRenderPass({
    colorAttachments: [{ view: output.createView(), clearValue: [0, 0, 0, 0], loadOp: "clear", storeOp: "store" }],
  });
  last.setPipeline(pipeline);
  last.setBindGroup(0, device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0),
    entries: [{ binding: 0, resource: { buffer: display.buffer } }, { binding: 1, resource: color }],
  }));
  last.draw(3);
  last.end();
  device.queue.submit([encoder.finish()]);
}

/** A picture of so many pixels as its bytes: RGBA, straight alpha. */
async function pixels(gpu, width, height, side) {
  const { device } = gpu;
  const texture = device.createTexture({
    size: [width, height], format: "rgba8unorm", usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
  });
  draw(gpu, texture, width, height, side);
  const bytesPerRow = Math.ceil((width * 4) / 256) * 256;
  const usage = GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ;
  const buffer = device.createBuffer({ size: bytesPerRow * height, usage });
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow }, [width, height]);
  device.queue.submit([encoder.finish()]);
  await buffer.mapAsync(GPUMapMode.READ);
  const rows = new Uint8Array(buffer.getMappedRange());
  const bytes = new Uint8ClampedArray(width * height * 4);
  for (let y = 0; y < height; y++) {
    bytes.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + width * 4), y * width * 4);
  }
  buffer.destroy();
  texture.destroy();
  for (let i = 0; i < bytes.length; i += 4) {
    const alpha = bytes[i + 3];
    if (alpha > 0 && alpha < 255) for (let c = i; c < i + 3; c++) bytes[c] = (bytes[c] * 255) / alpha;
  }
  return bytes;
}

/** Writes one picture into the page, for programs. */
async function writePixels(gpu) {
  const [width, height] = (options.get("size") ?? "256x256").split("x").map(Number);
  const bytes = await pixels(gpu, width, height, Number(options.get("samples") ?? 4));
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  const element = document.createElement("output");
  element.id = "pixels";
  element.textContent = btoa(text);
  document.body.append(element);
}

function slider(text, min, max, step, value, changed) {
  const label = document.createElement("label");
  const name = document.createElement("span");
  name.textContent = text;
  const input = Object.assign(document.createElement("input"), { type: "range", min, max, step });
  input.value = value;
  const output = document.createElement("output");
  const tell = () => (output.textContent = String(Number(Number(input.value).toPrecision(4))));
  input.addEventListener("input", () => { tell(); changed(Number(input.value)); });
  tell();
  label.append(name, input, output);
  document.getElementById("sliders").append(label);
}

function addSliders(gpu, redraw) {
  scene.materials.forEach((material, index) => {
    for (const parameter of material.parameters) {
      const values = [...parameter.value];
      const [low, high] = parameter.range ?? [Math.min(0, ...values), Math.max(1, ...values)];
      values.forEach((value, i) => {
        const text = values.length > 1 ? `${parameter.label} ${i + 1}` : parameter.label;
        const step = parameter.integer ? 1 : (high - low) / 1000 || "any";
        slider(text, low, high, step, value, (number) => {
          values[i] = number;
          setSource(gpu, `parameter:${parameter.name}`, values, [gpu.materials[index]]);
          redraw();
        });
      });
    }
  });
  if (scene.display.coded === 0) {
    slider("Exposure [stops]", -5, 5, 0.1, Math.log2(scene.display.exposure), (stops) => {
      scene.display.exposure = 2 ** stops;
      redraw();
    });
  }
}

/** What shows a frame on the canvas. A device that is a program on the CPU hands over bytes: browsers need not be able to
 * show its textures, and it is slow either way. */
function presenter(gpu) {
  const side = 2;
  const resize = (width, height) => {
    // Setting a size clears the canvas.
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  };
  if (gpu.software) {
    const context = canvas.getContext("2d");
    return async (width, height) => {
      const bytes = await pixels(gpu, width, height, side);
      resize(width, height);
      context.putImageData(new ImageData(bytes, width, height), 0, 0);
    };
  }
  const context = canvas.getContext("webgpu");
  context.configure({ device: gpu.device, format: navigator.gpu.getPreferredCanvasFormat(), alphaMode: "premultiplied" });
  return async (width, height) => {
    resize(width, height);
    draw(gpu, context.getCurrentTexture(), width, height, side);
  };
}

/** Draws whenever something changes; resolves when the first frame is there. */
async function run(gpu) {
  const present = presenter(gpu);
  const largest = Math.floor(gpu.device.limits.maxTextureDimension2D / 2);
  const started = performance.now();
  let [drawing, again, first] = [false, false, null];
  const frame = async () => {
    const box = canvas.getBoundingClientRect();
    const [width, height] = [box.width, box.height]
      .map((x) => Math.min(largest, Math.max(1, Math.round(x * devicePixelRatio))));
    scene.time = (performance.now() - started) / 1000;
    again = scene.moves;
    await present(width, height);
    drawing = false;
    first();
    if (again) redraw();
  };
  const redraw = () => {
    again = drawing;
    if (!drawing) requestAnimationFrame(() => frame().catch((error) => { show(error.message); first(); }));
    drawing = true;
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    const turn = (2 * Math.PI) / canvas.clientHeight;
    orbit(event.movementX * turn, event.movementY * turn);
    redraw();
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.offset = scaled(camera.offset, Math.exp(0.001 * event.deltaY));
    redraw();
  }, { passive: false });
  addSliders(gpu, redraw);
  await new Promise((resolve) => { first = resolve; redraw(); });
  new ResizeObserver(redraw).observe(canvas);
}

async function start() {
  const opened = await openDevice();
  let wrong = null;
  opened.device.addEventListener("uncapturederror", (event) => {
    wrong ??= event.error.message;
    show(wrong);
  });
  const gpu = await prepare(opened);
  await (options.has("pixels") ? writePixels(gpu) : run(gpu));
}

start().catch((error) => show(error.message)).finally(() => (document.documentElement.dataset.state = "done"));
