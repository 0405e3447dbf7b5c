// Two images, or maps of their errors, with a divider that pointer and keyboard move.
const chosenPicture = (side) => {
  const { pictures } = sceneShown();
  return state[side] === "reference" ? null : pictures.choices[Number(state[side])];
};

const fillSides = () => {
  const { pictures } = sceneShown();
  const points = scenePoints();
  const has = (at) => pictures.choices[at] !== null && pictures.choices[at] !== undefined;
  const order = points.map((_, at) => at).filter(has);
  const usual = { left: "reference", right: String(points.findIndex((p) => p.default)) };
  for (const side of ["left", "right"]) {
    if (state[side] !== "reference" && !has(Number(state[side] ?? NaN))) state[side] = usual[side];
    const options = order.map((at) => element("option", { value: at }, `${points[at].choice}${points[at].pareto ? " (front)" : ""}`));
    byId(side).replaceChildren(element("option", { value: "reference" }, "reference"), ...options);
    byId(side).value = state[side];
  }
};

const caption = (side) => {
  const picture = chosenPicture(side);
  if (!picture) return "reference";
  const point = scenePoints()[Number(state[side])];
  const rays = picture.rays === 1 ? "1 ray" : `${picture.rays} rays`;
  const over = point.samples_equal_time < 0.95 ? `, though only ${number(point.samples_equal_time)} fit into the time` : "";
  return `${point.choice}: ${rays} a pixel${over}; MSE ${number(picture.mse)}, FLIP ${number(picture.mean_flip)}, relative MSE ${number(picture.mean_relative)}`;
};

const black = "data:image/gif;base64,R0lGODlhAQABAIAAAAAAAP///ywAAAAAAQABAAACAUwAOw==";

const drawImages = () => {
  fillSides();
  const { pictures } = sceneShown();
  const map = state.view !== "image";
  for (const side of ["left", "right"]) {
    const picture = chosenPicture(side);
    const image = byId(`${side}-image`);
    image.src = picture ? picture[state.view] : map ? black : pictures.reference;
    image.alt = `${side}: ${caption(side)}${map ? `, ${state.view} map` : ""}`;
    image.style.aspectRatio = `${pictures.width} / ${pictures.height}`;
    byId(`${side}-caption`).textContent = `${side === "left" ? "◂ " : ""}${caption(side)}${side === "right" ? " ▸" : ""}`;
  }
  byId("compare").classList.toggle("map", map);
  byId("heat-legend").classList.toggle("on", map);
  const [least, most] = state.view === "flip" ? [0, 1] : pictures.relative_range;
  byId("heat-least").textContent = number(least);
  byId("heat-most").textContent = state.view === "flip" ? "1 FLIP" : `${number(most)} relative error`;
  divide();
};

const divide = () => {
  const at = Number(byId("slider").value);
  byId("left-image").style.clipPath = `inset(0 ${100 - at}% 0 0)`;
  byId("divider").style.left = `${at}%`;
};
