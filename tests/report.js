// What a reader does with the page of `lightbvh trade --out`, in a real browser: tests/report appends this to a copy of the page.
(async () => {
  const failed = [];
  let count = 0;
  const check = (holds, what) => {
    count += 1;
    if (!holds) failed.push(what);
  };
  const set = (id, value, event) => {
    const control = byId(id);
    if (control.type === "checkbox") control.checked = value;
    else control.value = value;
    control.dispatchEvent(new Event(event ?? "change", { bubbles: true }));
  };
  const press = (key) => document.activeElement.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
  const points = () => [...document.querySelectorAll("#plot .point")];
  const places = () => points().map((point) => point.querySelector("g").getAttribute("transform")).join();
  const seen = () => points().map((point) => point.getAttribute("aria-label")).sort().join("|");
  const shining = (rgb) => {
    const linear = rgb.match(/[\d.]+/g).slice(0, 3).map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const contrast = (node) => {
    const [a, b] = [getComputedStyle(node).color, getComputedStyle(document.body).backgroundColor].map(shining).sort((p, q) => q - p);
    return (a + 0.05) / (b + 0.05);
  };
  const decoded = async (id) => {
    await byId(id).decode();
    return byId(id).naturalWidth;
  };

  // The plot.
  const mine = scenePoints();
  check(points().length === mine.length && mine.length > 2, "a point for each choice");
  check(seen() === mine.map(wholeText).sort().join("|"), "each point says what it is");
  const svg = document.querySelector("#plot svg").getBoundingClientRect();
  check(points().every((point) => {
    const { left, right, top, bottom } = point.querySelector("path, circle").getBoundingClientRect();
    return left >= svg.left - 1 && right <= svg.right + 1 && top >= svg.top - 1 && bottom <= svg.bottom + 1;
  }), "all points lie within the plot");
  check(document.querySelectorAll("#plot .ring").length === mine.filter((p) => p.pareto).length, "a ring for each point of the front");
  check(document.querySelectorAll("#plot .label").length > 0, "some points have names");
  for (const key of Object.keys(measures)) {
    const before = places();
    const was = state.y;
    set("y", key);
    check(document.querySelector("#plot").textContent.includes(measures[key].label), `the axis says ${key}`);
    check(key === was || places() !== before, `points move for ${key}`);
    check(!places().includes("NaN"), `${key} has places`);
  }
  set("y", "error");
  const logarithmic = places();
  set("log", false);
  check(places() !== logarithmic, "the scale changes");
  set("log", true);
  check(places() === logarithmic, "and changes back");
  set("near", "2");
  check(points().length <= mine.length && seen().includes("default"), "the range narrows around the default");
  set("near", "");
  check(new URLSearchParams(location.hash.slice(1)).get("scene") === state.scene, "the address keeps the choice");

  // Pointer and keyboard.
  points()[0].dispatchEvent(new PointerEvent("pointerenter"));
  check(!byId("tip").hidden && byId("tip").textContent === points()[0].getAttribute("aria-label"), "hover tells the figures");
  points()[0].dispatchEvent(new PointerEvent("pointerleave"));
  check(byId("tip").hidden, "and stops");
  const stops = points().filter((point) => point.tabIndex === 0);
  check(stops.length === 1, "one stop of the Tab key");
  stops[0].focus();
  check(document.activeElement === stops[0] && !byId("tip").hidden, "focus tells the figures");
  const at = points().indexOf(stops[0]);
  press("ArrowRight");
  check(document.activeElement === points()[(at + 1) % mine.length], "an arrow goes to the next point");
  press("ArrowLeft");
  check(document.activeElement === points()[at], "and back");
  press("End");
  check(document.activeElement === points()[mine.length - 1], "End goes to the last");
  press("Escape");
  check(byId("tip").hidden, "Escape hides the figures");
  const chosen = mine.findIndex((p) => wholeText(p) === document.activeElement.getAttribute("aria-label"));
  press("Enter");
  check(state.point === chosen && document.querySelectorAll("#all tr.chosen").length === 1, "Enter chooses");
  check(byId("chosen").textContent === wholeText(mine[chosen]), "what is chosen is told below the plot");
  check(byId("right").value === String(chosen), "and shown");

  // Sentences and axes.
  check(byId("steps").children.length > 0, "steps along the front");
  const axes = [...new Set(mine.map((p) => p.config.axis))].filter((axis) => axis !== "default");
  check(axes.every((axis) => byId(`axis-${axis}`)), "each axis has its lines");
  check(document.querySelectorAll("#axes svg .point").length === mine.length - 1, "each choice has its line");
  check(document.querySelectorAll("#axes p").length === axes.length, "each axis has its sentence");

  // Tables.
  for (const hold of ["all", "errors", "times"]) {
    const cells = (column) => [...document.querySelectorAll(`#${hold} tbody tr`)].map((row) => row.children[column].firstChild.textContent);
    const heads = () => [...document.querySelectorAll(`#${hold} th`)];
    check(cells(0).length === mine.length, `${hold}: a row for each choice`);
    const last = heads().length - 1;
    for (const column of [0, last]) {
      for (const direction of ["ascending", "descending"]) {
        heads()[column].querySelector("button").click();
        check(heads()[column].getAttribute("aria-sort") === direction, `${hold}: says ${direction}`);
        const [first, second] = [cells(column)[0], cells(column).at(-1)];
        const [a, b] = column ? [Number(first), Number(second)] : [first, second];
        const order = column ? Math.sign(a - b) : Math.sign(a.localeCompare(b));
        check(order === 0 || (order < 0) === (direction === "ascending"), `${hold}: ${direction} by column ${column}`);
      }
    }
    check(heads()[last].querySelector("button") === document.activeElement, `${hold}: the focus stays`);
  }
  set("axis", axes[0]);
  check(document.querySelectorAll("#all tbody tr").length === mine.filter((p) => p.default || p.config.axis === axes[0]).length, "one axis alone");
  set("axis", "");

  // Images.
  const { pictures } = sceneShown();
  check(pictures.choices.some((picture) => picture), "there are pictures");
  for (const view of ["image", "flip", "relative"]) {
    const radio = document.querySelector(`#view [value=${view}]`);
    radio.checked = true;
    radio.dispatchEvent(new Event("change"));
    check(byId("right-image").src === pictures.choices[chosen][view], `the ${view} is shown`);
    check((await decoded("right-image")) === pictures.width, `the ${view} is an image`);
    check(byId("heat-legend").classList.contains("on") === (view !== "image"), `${view}: a legend of colours for maps alone`);
    check(byId("right-caption").textContent.includes("FLIP"), "the caption tells errors");
  }
  document.querySelector("#view [value=image]").click();
  check(byId("left-image").src === pictures.reference && (await decoded("left-image")) === pictures.width, "the reference is on the left");
  for (const value of [0, 20, 100]) {
    set("slider", value, "input");
    // Browsers shorten what they are given.
    const sides = byId("left-image").style.clipPath.match(/[\d.]+/g).map(Number);
    check(sides[1] === 100 - value && byId("divider").style.left === `${value}%`, `the divider goes to ${value}`);
  }
  check(byId("compare").getBoundingClientRect().width <= document.documentElement.clientWidth, "images fit the window");

  // Other scenes.
  for (const input of document.querySelectorAll("#scenes input")) {
    input.click();
    check(state.scene === input.value && seen() === scenePoints().map(wholeText).sort().join("|"), `scene ${input.value}`);
    check(byId("right-image").src === sceneShown().pictures.choices[Number(state.right)].image, `images of ${input.value}`);
  }

  // Colours and room.
  const grounds = ["light", "dark"].map((wanted) => {
    while (state.theme !== wanted) byId("theme").click();
    for (const id of ["made", "plot-hint", "steps"]) check(contrast(byId(id)) >= 4.5, `${wanted}: contrast of ${id}`);
    return shining(getComputedStyle(document.body).backgroundColor);
  });
  check(grounds[0] > 0.8 && grounds[1] < 0.05, "a light and a dark page");
  check(document.documentElement.scrollWidth <= innerWidth, `nothing is wider than the window of ${innerWidth}`);
  const named = [...document.querySelectorAll("select, input, button")].filter((control) => !(control.labels?.length || control.textContent.trim() || control.getAttribute("aria-label")));
  check(named.length === 0, "all controls have names");
  check(problems.length === 0, `errors: ${problems.join("; ")}`);
  return { failed, count };
})().catch((error) => ({ failed: [`the test itself: ${error.stack}`], count: 0 })).then(({ failed, count }) => {
  parent.postMessage(failed.length ? `FAILED ${failed.join(" / ")}` : `passed ${count} at ${innerWidth}`, "*");
});
