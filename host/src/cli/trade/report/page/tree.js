// The tree over the scene, cut at a depth, and how deep its lights lie.
const drawTree = () => {
  const { tree } = sceneShown();
  const depth = Math.min(Math.max(state.depth, 1), tree.cuts.length);
  const slider = byId("depth");
  slider.max = tree.cuts.length;
  slider.value = depth;
  const cut = tree.cuts[depth - 1];
  const unseen = cut.sets - cut.ellipses.length;
  byId("depth-text").textContent = `${depth} of ${tree.cuts.length}: ${number(cut.sets)} ${cut.sets === 1 ? "set" : "sets"} of lights${unseen ? `, ${number(unseen)} of them out of sight or too small to draw` : ""}`;
  const svg = drawing("svg", { viewBox: `0 0 ${tree.width} ${tree.height}`, role: "img", "aria-label": `Sets of lights at depth ${depth}` });
  svg.append(drawing("image", { href: tree.picture, width: tree.width, height: tree.height, opacity: byId("dim").checked ? 0.75 : 0 }));
  const most = Math.max(...cut.ellipses.map((e) => e.share), 1e-9);
  for (const e of [...cut.ellipses].reverse()) {
    const strength = Math.sqrt(e.share / most);
    const ellipse = drawing("ellipse", {
      cx: e.x, cy: e.y, rx: Math.max(e.rx, 1.2), ry: Math.max(e.ry, 1.2), transform: `rotate(${e.turn} ${e.x} ${e.y})`,
      fill: "#ffd34d", "fill-opacity": Math.min(0.14, 0.02 + 300 / (e.rx * e.ry + 2000)), stroke: "#ffb000", "stroke-opacity": 0.35 + 0.6 * strength, "stroke-width": 0.6 + 0.9 * strength,
    });
    if (e.kind === "mesh") ellipse.setAttribute("stroke-dasharray", "4 2");
    if (e.kind === "light") ellipse.setAttribute("stroke-dasharray", "1 2");
    ellipse.append(drawing("title", {}, `${e.kind}: ${number(100 * e.share)} % of the flux`));
    svg.append(ellipse);
  }
  byId("drawn").replaceChildren(svg);
};

const drawDepths = () => {
  const { tree, lights } = sceneShown();
  const hold = byId("depths");
  const width = Math.max(300, Math.round(hold.clientWidth || 800));
  const bars = tree.lights_by_depth.length;
  const [left, right, bottom, top] = [58, width - 16, 150, 16];
  const step = (right - left) / bars;
  const most = Math.max(...tree.lights_by_depth, 1);
  const svg = drawing("svg", { viewBox: `0 0 ${width} 190`, role: "img", "aria-label": `Lights by depth: ${tree.lights_by_depth.map((n, at) => `${at + 1}: ${n}`).join(", ")}` });
  tree.lights_by_depth.forEach((count, at) => {
    const middle = left + (at + 0.5) * step;
    const bar = (value, offset, fill, text) => {
      const height = Math.max(value * (bottom - top), value > 0 ? 1 : 0);
      return drawing("rect", { x: middle + offset * step * 0.36, y: bottom - height, width: step * 0.34, height, fill }, drawing("title", {}, text));
    };
    svg.append(bar(count / most, -1, "var(--c1)", `${number(count)} lights`));
    svg.append(bar(tree.flux_by_depth[at], 0.05, "var(--c2)", `${number(100 * tree.flux_by_depth[at])} % of the flux`));
    svg.append(drawing("text", { class: "soft", x: middle, y: bottom + 16, "text-anchor": "middle" }, String(at + 1)));
    if (count) svg.append(drawing("text", { class: "soft", x: middle, y: bottom - Math.max(count / most, tree.flux_by_depth[at]) * (bottom - top) - 3, "text-anchor": "middle" }, number(count)));
  });
  svg.append(drawing("text", { x: (left + right) / 2, y: 184, "text-anchor": "middle" }, "nodes on the path to a light"));
  hold.replaceChildren(svg, element("p", { class: "hint" }, `Lights (blue, of ${number(lights)}) and their share of the flux (gold, full height is all of it) by depth; ${number(tree.nodes)} nodes in all.`));
};
