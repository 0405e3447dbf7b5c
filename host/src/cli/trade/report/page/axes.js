// A line for each choice, by axis: its error at equal time over the default's.
const verdict = (axis, points) => {
  const of = (p) => p.equal_time_ratio;
  const best = points.reduce((a, b) => (of(a).median <= of(b).median ? a : b));
  const surely = of(best).high < 1;
  const maybe = points.filter((p) => of(p).low <= 1 && of(p).high >= 1);
  if (surely) return `${best.choice} has ${Math.round(100 * (1 - of(best).median))} % less error at equal time than the default.`;
  if (maybe.length) return `nothing is surely better than the default; not surely worse: ${maybe.map((p) => p.choice).join("; ")}.`;
  return `the default is surely better than all of them; the next is ${best.choice}, ${number(of(best).median)} times its error.`;
};

const drawAxes = () => {
  const hold = byId("axes");
  const points = scenePoints();
  const width = Math.max(300, Math.round(hold.clientWidth || 800));
  const narrow = width < 560;
  const label = narrow ? 16 : Math.min(300, width * 0.4);
  const others = points.filter((p) => !p.default);
  const values = others.flatMap((p) => Object.values(p.equal_time_ratio)).filter((v) => v > 0);
  const across = scale([...values, 1], [label + 8, width - 16], true);
  const axes = axisNames.filter((axis) => axis !== "default" && points.some((p) => p.config.axis === axis));
  const parts = [];
  for (const axis of axes) {
    const mine = points.map((point, at) => ({ point, at })).filter(({ point }) => point.config.axis === axis);
    const row = narrow ? 38 : 24;
    const height = mine.length * row + 30;
    const svg = drawing("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${axis}: ${mine.map(({ point }) => `${point.choice} ${interval(point.equal_time_ratio)}`).join("; ")}` });
    for (const v of ticks(across)) {
      svg.append(drawing("line", { class: "grid", x1: across.at(v), x2: across.at(v), y1: 4, y2: height - 20 }));
      svg.append(drawing("text", { class: "soft", x: across.at(v), y: height - 6, "text-anchor": "middle" }, number(v)));
    }
    svg.append(drawing("line", { stroke: "var(--ink)", "stroke-width": 1.5, x1: across.at(1), x2: across.at(1), y1: 4, y2: height - 20 }));
    mine.forEach(({ point, at }, k) => {
      const y = k * row + (narrow ? 28 : 16);
      const of = point.equal_time_ratio;
      const text = narrow ? { x: 10, y: y - 11 } : { x: label, y: y + 4, "text-anchor": "end" };
      const line = drawing("g", { class: at === state.point ? "point chosen" : "point" },
        drawing("text", text, point.choice),
        drawing("line", { stroke: color(axis), "stroke-width": 2.5, x1: across.at(of.low), x2: across.at(of.high), y1: y, y2: y }),
        drawing("g", { transform: `translate(${across.at(of.median)} ${y}) scale(0.85)` }, drawing("circle", { class: "halo", r: 10 }), shape(axis)));
      line.addEventListener("pointerenter", () => tip.show(wholeText(point), line.lastChild.getBoundingClientRect()));
      line.addEventListener("pointerleave", tip.hide);
      line.addEventListener("click", () => choose(at));
      svg.append(line);
    });
    const heading = element("h3", { id: `axis-${axis}` }, axis);
    parts.push(heading, svg, element("p", { class: "hint" }, `${axis[0].toUpperCase()}${axis.slice(1)}: ${verdict(axis, mine.map(({ point }) => point))}`));
  }
  hold.replaceChildren(...(parts.length ? parts : [element("p", {}, "Only the default was measured.")]));
};
