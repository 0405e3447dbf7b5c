// Points by two measures, with intervals and the front. Drawn as SVG and not by a library: each point is an element that the keyboard
// reaches and a screen reader reads, and colours follow the page.
const scale = (values, [from, to], log) => {
  const finite = values.filter((v) => Number.isFinite(v) && (!log || v > 0));
  let [low, high] = [Math.min(...finite), Math.max(...finite)];
  if (!finite.length) [low, high] = [1, 2];
  if (log) {
    const room = Math.max(high / low, 1.2) ** 0.06;
    [low, high] = [low / room, high * room];
  } else {
    const room = Math.max(high - low, Math.abs(high) * 0.1, 1e-9) * 0.06;
    [low, high] = [low - room, high + room];
  }
  const map = (v) => (log ? Math.log(Math.max(v, low / 1e3) / low) / Math.log(high / low) : (v - low) / (high - low));
  return { at: (v) => from + Math.min(Math.max(map(v), -0.1), 1.1) * (to - from), low, high, log };
};

const ticks = ({ low, high, log }) => {
  const steps = [1, 2, 5];
  if (log && high / low > 6) {
    const all = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1) {
      for (const step of high / low > 1e3 ? [1] : steps) all.push(step * 10 ** power);
    }
    return all.filter((v) => v >= low && v <= high);
  }
  const rough = (high - low) / 6;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((s) => s * power >= rough) ?? 10);
  const all = [];
  for (let k = Math.ceil(low / step); k * step <= high; k += 1) all.push(Number((k * step).toPrecision(12)));
  return all;
};

// Shapes beside colours, for those who do not see them.
const shapes = [
  "M-6 0 0-6 6 0 0 6Z", "M-5-5H5V5H-5Z", "M0-6 6 5H-6Z", "M0 6 6-5H-6Z", "M-6-2H-2V-6H2V-2H6V2H2V6H-2V2H-6Z",
  "M0-6 2-2 6-1.5 3 1.5 4 6 0 3.5-4 6-3 1.5-6-1.5-2-2Z", "M-6-5H0L6 0 0 5H-6Z", "M6-5H0L-6 0 0 5H6Z", "M-3-6H3V6H-3Z", "M-6-3H6V3H-6Z",
];
const shape = (axis) => {
  const at = axisNumber(axis);
  return at === 0 ? drawing("circle", { r: 6, fill: color(axis) }) : drawing("path", { d: shapes[at], fill: color(axis) });
};

// What no other point has less of in both, by medians; of the measured front alone where the axes are its own.
const frontOf = (all, x, y) => {
  const points = state.x === "frame" && state.y === "error" ? all.filter((p) => p.pareto) : all;
  const better = (m, a, b) => (m.less ? a < b : a > b);
  const beats = (a, b) => {
    const [ax, bx, ay, by] = [x.of(a).median, x.of(b).median, y.of(a).median, y.of(b).median];
    return !better(x, bx, ax) && !better(y, by, ay) && (better(x, ax, bx) || better(y, ay, by));
  };
  return points.filter((p) => !points.some((other) => beats(other, p)));
};

// Those that are neither far above nor far below the default in either measure; all where the range is not narrowed.
const within = (points, x, y) => {
  const home = points.find((p) => p.default);
  const near = (m, p) => {
    const [a, b] = [m.of(p).median, m.of(home).median];
    return a === b || (a > 0 && b > 0 && Math.max(a / b, b / a) <= Number(state.near));
  };
  const known = (at) => Object.values({ ...x.of(points[at]) }).concat(Object.values(y.of(points[at]))).every(Number.isFinite);
  return points.map((_, at) => at).filter((at) => known(at) && (!state.near || (near(x, points[at]) && near(y, points[at]))));
};

// Names of points where they cover neither each other nor a point nor an interval: of the front first.
const labels = (points, shown, place, bars, width) => {
  const marks = shown.map((at) => place(points[at])).map(([x, y]) => ({ left: x - 8, right: x + 8, top: y - 8, bottom: y + 8 }));
  const clear = (box, taken) => !taken.some((other) => box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom);
  const made = [];
  const order = [...shown].sort((a, b) => (points[b].default - points[a].default) || (points[b].pareto - points[a].pareto));
  for (const at of order) {
    const [x, y] = place(points[at]);
    const long = points[at].choice.length * 6 + 4;
    const places = [[x + 12, y + 4, "start"], [x - 12, y + 4, "end"], [x, y - 13, "middle"], [x, y + 21, "middle"], [x + 10, y - 9, "start"], [x + 10, y + 17, "start"], [x - 10, y - 9, "end"], [x - 10, y + 17, "end"]];
    // What counts most is named from afar, if need be.
    if (points[at].default || points[at].pareto) {
      for (const far of [36, 56, 80, 110]) {
        for (const [dx, dy] of [[1, -1], [-1, -1], [1, 1], [-1, 1], [0, -1], [0, 1]]) {
          places.push([x + dx * far, y + dy * far * 0.7, dx > 0 ? "start" : dx < 0 ? "end" : "middle"]);
        }
      }
    }
    for (const [tx, ty, anchor] of places) {
      const left = tx - { start: 0, middle: long / 2, end: long }[anchor];
      const box = { left, right: left + long, top: ty - 11, bottom: ty + 3 };
      if (left < 60 || box.right > width - 4 || box.top < 4 || !clear(box, made.map((label) => label.box)) || !clear(box, marks) || !clear(box, bars)) continue;
      const text = drawing("text", { class: "label", x: tx, y: ty, "text-anchor": anchor }, points[at].choice);
      const away = Math.hypot(tx - x, ty - y) > 30;
      made.push({ box, drawn: away ? [drawing("line", { class: "leader", x1: x, y1: y, x2: tx, y2: ty - 4 }), text] : [text] });
      break;
    }
  }
  return made.flatMap((label) => label.drawn);
};

const drawPlot = () => {
  const [x, y] = [measures[state.x], measures[state.y]];
  const points = scenePoints();
  const shown = within(points, x, y);
  const hold = byId("plot");
  const width = Math.max(300, Math.round(hold.clientWidth || 800));
  const height = Math.round(Math.min(520, Math.max(320, width * 0.56)));
  const all = (m) => shown.flatMap((at) => Object.values(m.of(points[at])));
  const log = (m) => state.log && all(m).every((v) => v > 0);
  const across = scale(all(x), [58, width - 16], log(x));
  const up = scale(all(y), [height - 48, 14], log(y));
  const svg = drawing("svg", { viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": `Choices by ${x.label} and ${y.label}` });
  for (const v of ticks(across)) {
    svg.append(drawing("line", { class: "grid", x1: across.at(v), x2: across.at(v), y1: 14, y2: height - 48 }));
    svg.append(drawing("text", { class: "soft", x: across.at(v), y: height - 32, "text-anchor": "middle" }, number(v)));
  }
  for (const v of ticks(up)) {
    svg.append(drawing("line", { class: "grid", x1: 58, x2: width - 16, y1: up.at(v), y2: up.at(v) }));
    svg.append(drawing("text", { class: "soft", x: 52, y: up.at(v) + 4, "text-anchor": "end" }, number(v)));
  }
  svg.append(drawing("text", { x: (58 + width - 16) / 2, y: height - 10, "text-anchor": "middle" }, x.label));
  svg.append(drawing("text", { transform: `translate(14 ${(height - 34) / 2}) rotate(-90)`, "text-anchor": "middle" }, y.label));
  const place = (p) => [across.at(x.of(p).median), up.at(y.of(p).median)];
  const front = frontOf(points, x, y).filter((p) => shown.includes(points.indexOf(p))).map(place).sort((a, b) => a[0] - b[0]);
  svg.append(drawing("polyline", { class: "front", points: front.map((at) => at.join(",")).join(" ") }));
  // By place from left to right: the order of the keyboard.
  const order = [...shown].sort((a, b) => place(points[a])[0] - place(points[b])[0]);
  const current = shown.includes(state.point) ? state.point : points.findIndex((p) => p.default);
  const groups = new Map();
  const bars = [];
  for (const at of order) {
    const point = points[at];
    const [px, py] = place(point);
    const [rx, ry] = [x.of(point), y.of(point)];
    const group = drawing("g", { class: `point${at === state.point ? " chosen" : ""}`, tabindex: at === current ? 0 : -1, role: "button", "aria-label": wholeText(point) });
    bars.push({ left: across.at(rx.low), right: across.at(rx.high), top: py - 2, bottom: py + 2 }, { left: px - 2, right: px + 2, top: up.at(ry.high), bottom: up.at(ry.low) });
    group.append(drawing("line", { class: "range", stroke: color(point.config.axis), x1: across.at(rx.low), x2: across.at(rx.high), y1: py, y2: py }));
    group.append(drawing("line", { class: "range", stroke: color(point.config.axis), x1: px, x2: px, y1: up.at(ry.low), y2: up.at(ry.high) }));
    const mark = drawing("g", { transform: `translate(${px} ${py})` }, drawing("circle", { class: "halo", r: 12 }), shape(point.config.axis));
    if (point.pareto) mark.append(drawing("circle", { class: "ring", r: 9.5 }));
    group.append(mark);
    group.addEventListener("pointerenter", () => tip.show(wholeText(point), mark.getBoundingClientRect()));
    group.addEventListener("pointerleave", tip.hide);
    group.addEventListener("focus", () => tip.show(wholeText(point), mark.getBoundingClientRect()));
    group.addEventListener("blur", tip.hide);
    group.addEventListener("click", () => choose(at));
    group.addEventListener("keydown", (event) => move(event, order, at, groups));
    groups.set(at, group);
    svg.append(group);
  }
  svg.append(...labels(points, shown, place, bars, width));
  hold.replaceChildren(svg);
  byId("chosen").hidden = state.point === null;
  if (state.point !== null) byId("chosen").textContent = wholeText(points[state.point]);
  const own = state.x === "frame" && state.y === "error";
  const away = points.filter((p, at) => p.pareto && !shown.includes(at)).map((p) => p.choice);
  const unknown = points.filter((p) => ![x.of(p).median, y.of(p).median].every(Number.isFinite)).map((p) => p.choice);
  byId("plot-hint").textContent = `${away.length ? `On the front, but out of this range: ${away.join("; ")}. ` : ""}${unknown.length ? `Not shown, infinite or unknown: ${unknown.join("; ")}. ` : ""}Each point is a choice; lines about it are intervals of 95 %. ${state.y === "equal" ? "Below 1 is less error than the default's in the same time. " : ""}${own ? "Rings mark the front: what nothing else beats in update, image and error, the default for all that are like it; the dashed line joins those of them that have the least error for their frame" : "The dashed line joins what nothing is better than in both, by medians; rings mark the front of update, image and error"}. Tab enters the points, arrow keys go along them, Enter chooses one.`;
};

const move = (event, order, at, groups) => {
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  let to = null;
  if (step) to = order[(order.indexOf(at) + step + order.length) % order.length];
  if (event.key === "Home") to = order[0];
  if (event.key === "End") to = order[order.length - 1];
  if (event.key === "Enter" || event.key === " ") {
    choose(at);
    byId("plot").querySelector(".chosen")?.focus();
  }
  if (event.key === "Escape") tip.hide();
  if (to !== null) groups.get(to).focus();
  if (to !== null || event.key === " " || event.key === "Enter") event.preventDefault();
};

const drawLegend = () => {
  const axes = axisNames.map((axis) => element("span", {}, drawing("svg", { viewBox: "-8 -8 16 16" }, shape(axis)), axis));
  byId("legend").replaceChildren(...axes, element("span", {}, drawing("svg", { viewBox: "-8 -8 16 16" }, drawing("circle", { class: "ring", r: 7 })), "on the front"));
  const least = scenePoints().reduce((a, b) => (a.equal_time_ratio.median <= b.equal_time_ratio.median ? a : b));
  const share = 1 - least.equal_time_ratio.median;
  byId("best").textContent = least.default || least.equal_time_ratio.high >= 1
    ? "At equal time nothing here has surely less error than the default."
    : `At equal time ${least.choice} has the least error: ${number(Math.round(100 * share))} % less than the default.`;
  const mine = data.steps.filter((step) => step.startsWith(`${state.scene}: `)).map((step) => step.slice(state.scene.length + 2));
  byId("steps").replaceChildren(...(mine.length ? mine : ["The front is one point: the fastest choice has the least error."]).map((step) => element("li", {}, step)));
};
