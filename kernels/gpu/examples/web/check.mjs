// What a visitor does with the page, in a real browser: node check.mjs BROWSER FOLDER. The folder holds index.html.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

// 1: the page failed. 2: the browser did.
process.on("uncaughtException", (error) => {
  console.error(error.message);
  process.exit(2);
});

const [browser, folder] = process.argv.slice(2);
const page = `file://${resolve(folder)}/index.html`;
let failed = 0;
const check = (holds, what) => {
  if (!holds) failed += 1;
  console.log(`${holds ? "passed" : "FAILED"}: ${what}`);
};

// A browser, by the DevTools protocol over pipes.
async function open(...flags) {
  const profile = mkdtempSync(join(tmpdir(), "lightbvh-web-"));
  const all = ["--headless=new", "--no-sandbox", "--no-first-run", "--hide-scrollbars", "--remote-debugging-pipe", `--user-data-dir=${profile}`, "--host-resolver-rules=MAP * ~NOTFOUND", ...flags, "about:blank"];
  const child = spawn(browser, all, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const [, , , to, from] = child.stdio;
  const waiting = new Map();
  const problems = [];
  let [count, text] = [0, ""];
  from.setEncoding("utf8").on("data", (own) => {
    const parts = (text + own).split("\0");
    text = parts.pop();
    for (const { id, result, error, method, params } of parts.map((part) => JSON.parse(part))) {
      if (id) waiting.get(id)(error ? Promise.reject(new Error(error.message)) : result);
      if (method === "Runtime.exceptionThrown") problems.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
      if (method === "Runtime.consoleAPICalled" && params.type === "error") problems.push(params.args.map((own) => own.value ?? own.description).join(" "));
      if (method === "Log.entryAdded" && params.entry.level === "error") problems.push(params.entry.text);
    }
  });
  let sessionId;
  const send = (method, params = {}) => new Promise((done) => {
    count += 1;
    waiting.set(count, done);
    to.write(`${JSON.stringify({ id: count, method, params, sessionId })}\0`);
  });
  const { targetInfos } = await send("Target.getTargets");
  const { targetId } = targetInfos.find((own) => own.type === "page");
  ({ sessionId } = await send("Target.attachToTarget", { targetId, flatten: true }));
  for (const domain of ["Page", "Runtime", "Log"]) await send(`${domain}.enable`);
  const evaluate = async (expression) => {
    const { result, exceptionDetails } = await send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) {
      await own.shoot("failed.png").catch(() => {});
      console.error(problems.join("\n"));
      throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    }
    return result.value;
  };
  const own = {
    send, evaluate, problems,
    size: (width, height) => send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: width < 600 }),
    media: (scheme, motion = "no-preference") => send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }, { name: "prefers-reduced-motion", value: motion }] }),
    // Whether the page started. It makes frames by itself if it is to be left `alone`.
    visit: async (alone) => {
      await send("Page.addScriptToEvaluateOnNewDocument", { source: `addEventListener("DOMContentLoaded", () => { main.isFixed = ${!alone}; })` });
      await send("Page.navigate", { url: `${page}?${count}` });
      for (;;) {
        if (await evaluate("document.readyState === 'complete' && typeof started === 'object'")) return evaluate("started.then((own) => own !== null && own !== undefined)");
        await new Promise((done) => setTimeout(done, 50));
      }
    },
    press: async (key, code) => {
      for (const type of ["keyDown", "keyUp"]) await send("Input.dispatchKeyEvent", { type, key, code: key, windowsVirtualKeyCode: code });
    },
    shoot: async (name) => {
      const { data } = await send("Page.captureScreenshot", { format: "png", captureBeyondViewport: true });
      writeFileSync(join(folder, name), Buffer.from(data, "base64"));
    },
    close: async () => {
      const ended = new Promise((done) => child.on("exit", done));
      send("Browser.close");
      await ended;
      rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
    },
  };
  return own;
}

// In the page. The words of a buffer.
const read = `globalThis.read = async (from) => {
  const { device } = await started;
  const to = device.createBuffer({ size: from.size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(from, 0, to, 0, from.size);
  device.queue.submit([encoder.finish()]);
  await to.mapAsync(GPUMapMode.READ);
  return new Uint32Array(to.getMappedRange());
}; 0`;

// In the page. Mean colours of images, by either side alone.
const images = `(async () => {
  const { sums, setBudget, step } = await started;
  setBudget(2000);
  const means = [[], []];
  for (let k = 0; k < 32; k += 1) {
    Object.assign(chosen, { split: k % 2, candidates: 32 });
    isChanged = true;
    step(0);
    const colors = new Float32Array((await read(sums())).buffer).filter((_, k) => k % 4 < 3);
    means[k % 2].push(colors.reduce((sum, own) => sum + own) / colors.length);
  }
  return means;
})()`;

// In the page. The device's u32s after frames; how often its samples are the CPU's, and their pmfs those that it says itself; the sum of
// pmfs over all lights of a point.
const compare = `(async () => {
  const { device, host, held, layouts, tree, group, named, step } = await started;
  let [all, different] = [0, 0];
  for (let k = 0; k < 6; k += 1) {
    chosen.instances = [20, 20, 37, 37, 20, 20][k];
    step(0.5);
    const buffers = await Promise.all(held.map(read));
    const address = host.wasm.in_use();
    const [count] = host.words(address, 1);
    const ranges = host.words(address + 4, 4 * count);
    for (let r = 0; r < count; r += 1) {
      const [buffer, at, from, length] = ranges.subarray(4 * r);
      host.words(from, length / 4).forEach((word, i) => { different += word !== buffers[buffer][at / 4 + i]; });
      all += length / 4;
    }
  }
  const code = document.getElementById("lightbvh").textContent + \`
    @group(1) @binding(0) var<storage, read_write> out: array<vec4u>;
    @compute @workgroup_size(64) fn test(@builtin(global_invocation_id) id: vec3u) {
      let k = id.x;
      let p = vec3f(f32(k % 64u) * 0.4 - 12.8, 0.001, f32(k / 64u) * 0.4 - 12.8);
      let own = lightbvh_sample(p, vec3f(0.0, 1.0, 0.0), vec2u(k * 2654435769u, 77u));
      out[k] = vec4u(own.light, own.instance, bitcast<u32>(own.pmf), bitcast<u32>(lightbvh_pmf(p, vec3f(0.0, 1.0, 0.0), own.light, own.instance)));
      // 2,000 lights: 20 instances of 100.
      var sum = 0.0;
      let q = vec3f(f32(k) * 0.01, 0.001, 3.0);
      for (var i = 0u; i < select(0u, 2000u, k < 8u); i++) {
        let instance = PLACES[i / 100u];
        sum += lightbvh_pmf(q, vec3f(0.0, 1.0, 0.0), lightbvh_instances.list[instance].first + i % 100u, instance);
      }
      if k < 8u { out[4096u + k] = vec4u(bitcast<u32>(sum), 0u, 0u, 0u); }
    }\`;
  const { live, tree: words } = host.follow();
  const places = "const PLACES = array(" + [...live].map((own) => own + "u").join() + ");";
  const layout = device.createBindGroupLayout({ entries: [{ binding: 0, visibility: GPUShaderStage.COMPUTE, buffer: { type: "storage" } }] });
  const pipeline = device.createComputePipeline({ layout: device.createPipelineLayout({ bindGroupLayouts: [layouts.tree, layout] }), compute: { module: device.createShaderModule({ code: places + code }) } });
  const out = device.createBuffer({ size: 16 * 4160, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, group(layouts.tree, named("nodes"), named("instances"), named("trails"), named("lights"), tree));
  pass.setBindGroup(1, group(layout, out));
  pass.dispatchWorkgroups(64);
  pass.end();
  device.queue.submit([encoder.finish()]);
  const found = await read(out);
  const floats = new Float32Array(found.buffer, found.byteOffset, found.length);
  let [others, worst] = [0, 0];
  for (let k = 0; k < 4096; k += 1) {
    const [x, z] = [k % 64 * Math.fround(0.4) - 12.8, Math.floor(k / 64) * Math.fround(0.4) - 12.8];
    const [light, instance] = host.words(host.wasm.sample(x, 0.001, z, Math.imul(k, 2654435769), 77), 3);
    others += light !== found[4 * k] || instance !== found[4 * k + 1];
    worst = Math.max(worst, Math.abs(floats[4 * k + 3] / floats[4 * k + 2] - 1));
  }
  const sums = [...Array(8).keys()].map((k) => floats[4 * (4096 + k)]);
  return { all, different, others, worst, sums };
})()`;

// Canvas and page are drawn by the same software device: without it the browser loses the canvas.
const flags = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--use-gl=angle", "--use-angle=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader"];
let own = await open(...flags);
await own.size(1280, 900);
await own.media("light");
check(await own.visit(true), "the page starts");
const times = `["edits", "refit", "image", "left", "right"].map((id) => byId(id).querySelector(".figure").textContent).join(", ")`;
for (let k = 0; k < 200 && (await own.evaluate(times)).includes("–"); k += 1) await new Promise((done) => setTimeout(done, 100));
const shown = await own.evaluate(times);
check(/^([\d.]+ m?s(, |$)){5}$/.test(shown), `times of edits, refit, image and its sides: ${shown}`);
await own.evaluate("main.isFixed = true; started.then(({ device }) => device.queue.onSubmittedWorkDone())");
await own.evaluate(read);
const found = await own.evaluate(compare);
check(found.different <= 0.01 * found.all, `u32s on the device: ${found.different} of ${found.all} differ from the CPU's`);
check(found.others <= 41, `samples: ${found.others} of 4096 are other lights than the CPU's`);
check(found.worst < 0.01, `a sample's probability is its pmf, to ${found.worst}`);
check(found.sums.every((sum) => Math.abs(sum - 1) < 1e-3), `probabilities of all lights sum to ${found.sums}`);

// Of 16 images each, the same in each run; six standard errors of their difference.
await own.visit();
await own.evaluate(read);
const [tree, uniform] = (await own.evaluate(images)).map((means) => {
  const mean = means.reduce((sum, own) => sum + own) / means.length;
  const squares = means.reduce((sum, own) => sum + (own - mean) ** 2, 0);
  return { mean, variance: squares / (means.length - 1) / means.length };
});
const apart = Math.abs(tree.mean - uniform.mean);
const bound = 6 * Math.sqrt(tree.variance + uniform.variance);
check(apart < bound && bound < 0.1 * uniform.mean, `both sides have a mean of ${uniform.mean}: apart by ${apart}, less than ${bound}`);

// Keys, as a visitor presses them.
const value = (id) => own.evaluate(`document.getElementById("${id}").value + " " + (document.getElementById("${id}").parentElement.querySelector("output")?.value ?? "")`);
for (const [id, key, code, before, after] of [
  ["lights", "ArrowLeft", 37, "30 100,000", "29 79,400"], ["motion", "ArrowRight", 39, "10 1.0×", "11 1.1×"],
  ["candidates", "Home", 36, "8 8", "1 1"], ["split", "ArrowRight", 39, "50 ", "51 "],
]) {
  const was = await value(id);
  await own.evaluate(`document.getElementById("${id}").focus()`);
  await own.press(key, code);
  const now = await value(id);
  check(was === before && now === after, `${key} on ${id}: from ${was} to ${now}`);
}
await own.evaluate("byId('pause').focus()");
await own.send("Input.dispatchKeyEvent", { type: "keyDown", key: " ", code: "Space", windowsVirtualKeyCode: 32, text: " " });
await own.send("Input.dispatchKeyEvent", { type: "keyUp", key: " ", code: "Space", windowsVirtualKeyCode: 32 });
check(await own.evaluate("chosen.isPaused && byId('pause').textContent === 'Play'"), "Space on the button pauses");

// The divider, by finger and mouse.
await own.send("Emulation.setTouchEmulationEnabled", { enabled: true });
const { x, y, width: wide } = await own.evaluate("(({ x, y, width }) => ({ x, y, width }))(byId('split').getBoundingClientRect())");
const drag = async (kind, event, ...types) => {
  for (const [k, type] of types.entries()) {
    const at = { x: x + wide * [0.5, 0.7, 0.7][k], y: y + 60 };
    await own.send(`Input.dispatch${kind}Event`, { type, ...event(at, type) });
  }
  return value("split");
};
const touched = await drag("Touch", (at, type) => ({ touchPoints: type === "touchEnd" ? [] : [at] }), "touchStart", "touchMove", "touchEnd");
check(touched === "70 ", `the divider follows a finger to ${touched}`);
await own.evaluate("byId('split').value = 50");
const dragged = await drag("Mouse", (at) => ({ ...at, button: "left", clickCount: 1 }), "mousePressed", "mouseMoved", "mouseReleased");
check(dragged === "70 ", `the divider follows the mouse to ${dragged}`);

// Themes and widths.
for (const [scheme, width, height] of [["light", 1280, 900], ["dark", 1280, 900], ["light", 360, 900], ["dark", 360, 900]]) {
  await own.size(width, height);
  await own.media(scheme, "reduce");
  await own.visit();
  check(await own.evaluate("chosen.isPaused"), `${scheme}, ${width}: reduced motion begins with a pause`);
  check(await own.evaluate("document.documentElement.scrollWidth <= innerWidth"), `${scheme}, ${width}: nothing is wider than the page`);
  await own.evaluate(`(async () => {
    const { device, step, setBudget } = await started;
    setBudget(${width} * 70);
    step(0);
    await device.queue.onSubmittedWorkDone();
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  })()`);
  await own.shoot(`${scheme}-${width}.png`);
}
check(own.problems.length === 0, `nothing on the console ${own.problems.join("\n")}`);
await own.close();

// Without WebGPU, and without a device.
own = await open("--disable-gpu", "--disable-software-rasterizer");
await own.size(1280, 900);
for (const [name, source] of [["a device", ""], ["WebGPU", "Object.defineProperty(Navigator.prototype, 'gpu', { value: undefined })"]]) {
  await own.send("Page.addScriptToEvaluateOnNewDocument", { source });
  check(!await own.visit(), `without ${name} the page does not start`);
  const message = await own.evaluate("byId('message').hidden ? '' : byId('message').innerText");
  check(message.includes(name === "WebGPU" ? "needs WebGPU" : "no graphics device"), `without ${name}: ${message.replace(/\s+/g, " ")}`);
  await own.shoot(`without-${name.split(" ").at(-1)}.png`);
}
check(own.problems.length === 0, `then nothing on the console ${own.problems.join("\n")}`);
await own.close();
process.exit(failed > 0 ? 1 : 0);
