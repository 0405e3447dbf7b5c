// The page as a whole: its controls, and what is drawn again when.
const drawScene = () => {
  state.point = null;
  address();
  drawLegend();
  drawPlot();
  drawAxes();
  drawImages();
  drawTables();
};

const theme = (chosen) => {
  state.theme = chosen;
  if (chosen) document.documentElement.dataset.theme = chosen;
  else delete document.documentElement.dataset.theme;
  byId("theme").textContent = `Colours: ${chosen || "as the system"}`;
  address();
};

const begin = () => {
  const { made } = data;
  byId("made").textContent = `lightbvh ${made.version} on ${made.machine}, ${made.threads} threads, ${made.date}: CPU images of ${data.width} × ${data.height} in frames ${data.frames.join(", ")}, ${data.samples} shadow rays of a pixel where all have as many, ${data.turns} turns of times`;
  const scenes = data.scenes.map((scene) => {
    const input = element("input", { type: "radio", name: "scene", value: scene.name });
    input.checked = scene.name === state.scene;
    input.addEventListener("change", () => {
      state.scene = scene.name;
      drawScene();
    });
    return element("label", {}, input, scene.name);
  });
  byId("scenes").append(...scenes);
  for (const axis of ["x", "y"]) {
    byId(axis).append(...Object.entries(measures).map(([key, { label }]) => element("option", { value: key }, label)));
    byId(axis).value = state[axis];
    byId(axis).addEventListener("change", (event) => {
      state[axis] = event.target.value;
      address();
      drawPlot();
    });
  }
  byId("near").value = state.near;
  byId("near").addEventListener("change", (event) => {
    state.near = event.target.value;
    address();
    drawPlot();
  });
  byId("log").addEventListener("change", (event) => {
    state.log = event.target.checked;
    drawPlot();
  });
  for (const side of ["left", "right"]) {
    byId(side).addEventListener("change", (event) => {
      state[side] = event.target.value;
      drawImages();
    });
  }
  for (const input of document.querySelectorAll("#view input")) {
    input.addEventListener("change", () => {
      state.view = input.value;
      drawImages();
    });
  }
  byId("slider").addEventListener("input", divide);
  byId("axis").append(element("option", { value: "" }, "all"), ...axisNames.map((axis) => element("option", { value: axis }, axis)));
  byId("axis").addEventListener("change", (event) => {
    state.axis = event.target.value;
    drawTables();
  });
  byId("theme").addEventListener("click", () => theme({ "": "light", light: "dark", dark: "" }[state.theme]));
  byId("paper-hint").textContent = "Measures and times as the paper's tables have them, of every choice here; “eq4” is the paper's importance.";
  const how = {
    command: element("code", {}, made.command),
    program: `lightbvh ${made.version}${made.optimised ? "" : ", not optimised: times say nothing"}`,
    machine: `${made.machine}, ${made.threads} threads`,
    date: made.date,
    images: `${data.width} × ${data.height} pixels, frames ${data.frames.join(", ")}, ${data.samples} shadow rays a pixel where all have the same; errors are of images as displayed, squared steps of a byte`,
    times: `in turn, ${data.turns} turns for samples; ratios are taken turn by turn and seed by seed, intervals are of 95 %`,
    front: "a choice is on the front unless another one surely has less of an update's time, an image's or of its error, and seems to have more of none: less is a fifth of an update, a tenth of an image, and of error what lies beyond the interval. What is like the default in all is counted as the default",
  };
  byId("how").append(...Object.entries(how).flatMap(([key, text]) => [element("dt", {}, key), element("dd", {}, text)]));
  theme(state.theme);
  drawScene();
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    drawPlot();
    drawAxes();
  });
};

begin();
