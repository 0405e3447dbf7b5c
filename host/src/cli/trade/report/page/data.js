// The data, what can be an axis of the plot, and how numbers are written.
const data = JSON.parse(document.getElementById("data").textContent);

const byId = (id) => document.getElementById(id);

const element = (name, attributes = {}, ...children) => {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
};

const drawing = (name, attributes = {}, ...children) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
};

// Three digits, as people write them.
const number = (value) => {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size >= 1e6 || size < 1e-3) return value.toExponential(2);
  return size >= 100 ? Math.round(value).toLocaleString("en") : String(Number(value.toPrecision(3)));
};

const interval = (of) => `${number(of.median)} [${number(of.low)}, ${number(of.high)}]`;

// JSON has no infinity: what is not finite comes as nothing.
const exactly = (value) => ({ median: value ?? NaN, low: value ?? NaN, high: value ?? NaN });

const measures = {
  frame: { label: "time of a frame, over the default's", of: (p) => p.frame_ratio, less: true },
  error: { label: "error by the same rays, over the default's", of: (p) => p.error_ratio, less: true },
  equal: { label: "error at equal time, over the default's", of: (p) => p.equal_time_ratio, less: true },
  sample: { label: "time of a sample, over the default's", of: (p) => p.sample_ratio, less: true },
  ns: { label: "time of a sample, ns", of: (p) => exactly(p.ns_per_sample), less: true },
  variance: { label: "variance without shadows, mean", of: (p) => exactly(p.variance), less: true },
  median: { label: "variance without shadows, median", of: (p) => exactly(p.variance_median), less: true },
  bytes: { label: "bytes for a light", of: (p) => exactly(p.bytes_per_light), less: true },
  build: { label: "build, ms", of: (p) => exactly(p.build_ms), less: true },
  update: { label: "update of a frame, ms", of: (p) => exactly(p.update_ms), less: true },
  image: { label: "image, ms", of: (p) => exactly(p.image_ms), less: true },
  flip: { label: "FLIP by the same rays", of: (p) => exactly(p.quality.flip), less: true },
  relative: { label: "relative MSE by the same rays", of: (p) => exactly(p.quality.relative_mse), less: true },
  ssim: { label: "SSIM by the same rays", of: (p) => exactly(p.quality.ssim), less: false },
};

// The same colours and shapes in every report, whichever axes it has.
const allAxes = ["default", "importance", "builder", "levels", "update", "candidates"];
const axisNames = allAxes.filter((axis) => data.points.some((point) => point.config.axis === axis));
const axisNumber = (axis) => Math.max(0, allAxes.indexOf(axis));
const color = (axis) => `var(--c${axisNumber(axis)})`;

// What the user chose; a part of the address, so that it can be sent to others.
const state = { scene: data.scenes[0].name, x: "frame", y: "error", log: true, near: "", point: null, left: null, right: null, view: "image", axis: "", theme: "" };
for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
  if (key === "scene" && data.scenes.some((scene) => scene.name === value)) state.scene = value;
  if ((key === "x" || key === "y") && Object.hasOwn(measures, value)) state[key] = value;
  if (key === "near" && ["2", "1.2"].includes(value)) state.near = value;
  if (key === "theme" && ["light", "dark"].includes(value)) state.theme = value;
}

const address = () => {
  const parts = new URLSearchParams({ scene: state.scene, x: state.x, y: state.y });
  if (state.near) parts.set("near", state.near);
  if (state.theme) parts.set("theme", state.theme);
  history.replaceState(null, "", `#${parts}`);
};

const scenePoints = () => data.points.filter((point) => point.scene === state.scene);
const sceneShown = () => data.scenes.find((scene) => scene.name === state.scene);

const wholeText = (point) => {
  const lines = [
    `${point.choice}${point.default ? "" : ` (${point.config.axis})`}`,
    `frame: ${interval(point.frame_ratio)} of the default's time`,
    `error, same rays: ${interval(point.error_ratio)}`,
    `error, equal time: ${interval(point.equal_time_ratio)}`,
    `sample: ${number(point.ns_per_sample)} ns, variance ${number(point.variance)}, median ${number(point.variance_median)}`,
    `${number(point.bytes_per_light)} bytes for a light; build ${number(point.build_ms)} ms, update ${number(point.update_ms)} ms`,
  ];
  if (point.pareto) lines.push("on the front");
  return lines.join("\n");
};

// The text beside what the pointer or the keyboard is on.
const tip = {
  show(text, at) {
    const box = byId("tip");
    box.textContent = text;
    box.hidden = false;
    const { width, height } = box.getBoundingClientRect();
    const left = at.right + 8 + width < innerWidth ? at.right + 8 : Math.max(4, at.left - 8 - width);
    box.style.left = `${left}px`;
    box.style.top = `${Math.min(Math.max(4, at.top), Math.max(4, innerHeight - height - 4))}px`;
  },
  hide() {
    byId("tip").hidden = true;
  },
};

const choose = (index) => {
  state.point = index;
  drawPlot();
  drawTables();
  const at = scenePoints()[index];
  if (at && sceneShown().pictures.choices[index]) {
    state.right = String(index);
    drawImages();
  }
};
