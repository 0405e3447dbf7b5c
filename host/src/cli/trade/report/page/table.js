// Tables that sort by what is clicked.
const sortedBy = {};

const table = (hold, columns, rows) => {
  const sorted = sortedBy[hold] ?? { column: 0, down: false };
  const value = (column, row) => column.value?.(row.point) ?? column.text(row.point);
  const order = sortedBy[hold]
    ? [...rows].sort((a, b) => {
        const [p, q] = [value(columns[sorted.column], a), value(columns[sorted.column], b)];
        const by = typeof p === "number" && typeof q === "number" ? p - q : String(p).localeCompare(String(q));
        return sorted.down ? -by : by;
      })
    : rows;
  const head = element("tr", {}, ...columns.map((column, at) => {
    const button = element("button", { type: "button", title: column.title ?? column.name }, column.name);
    button.addEventListener("click", () => {
      const same = sortedBy[hold]?.column === at;
      sortedBy[hold] = { column: at, down: same && !sorted.down };
      drawTables();
      byId(hold).querySelectorAll("th button")[at].focus();
    });
    const direction = sortedBy[hold] && sorted.column === at ? (sorted.down ? "descending" : "ascending") : "none";
    return element("th", { scope: "col", "aria-sort": direction }, button);
  }));
  const body = order.map((row) => {
    const cells = columns.map((column) => {
      const cell = element("td");
      const [main, small] = [column.text(row.point), column.small?.(row.point)];
      cell.append(main);
      if (small) cell.append(" ", element("small", {}, small));
      return cell;
    });
    const made = element("tr", {}, ...cells);
    made.classList.toggle("default", row.point.default);
    made.classList.toggle("chosen", row.index === state.point);
    made.addEventListener("click", () => choose(row.index));
    return made;
  });
  byId(hold).replaceChildren(element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
};

const range = (of) => `${number(of.low)}–${number(of.high)}`;
const ratioColumn = (name, get) => ({ name, value: (p) => get(p).median, text: (p) => number(get(p).median), small: (p) => (p.default ? "" : range(get(p))) });
const numberColumn = (name, get, title) => ({ name, title, value: get, text: (p) => number(get(p)) });
const choiceColumn = { name: "choice", text: (p) => p.choice };

const allColumns = [
  choiceColumn,
  { name: "axis", text: (p) => p.config.axis },
  { name: "front", text: (p) => (p.pareto ? "yes" : "") },
  ratioColumn("frame ×", (p) => p.frame_ratio),
  ratioColumn("error ×", (p) => p.error_ratio),
  ratioColumn("equal time ×", (p) => p.equal_time_ratio),
  numberColumn("error", (p) => p.error, "by the same rays, squared steps of a byte"),
  numberColumn("at equal time", (p) => p.error_equal_time, "squared steps of a byte"),
  numberColumn("rays", (p) => p.samples_equal_time, "shadow rays of a pixel in the default's time"),
  numberColumn("sample ns", (p) => p.ns_per_sample),
  numberColumn("variance", (p) => p.variance, "without shadows, mean"),
  numberColumn("variance, median", (p) => p.variance_median, "of the variance without shadows"),
  numberColumn("bytes/light", (p) => p.bytes_per_light),
  numberColumn("build ms", (p) => p.build_ms),
  numberColumn("refit ms", (p) => p.refit_ms),
  numberColumn("update ms", (p) => p.update_ms),
  numberColumn("background ms", (p) => p.beside_ms),
  numberColumn("image ms", (p) => p.image_ms),
  { name: "bias %", value: (p) => 100 * (p.bias?.mean ?? 0), text: (p) => (p.bias ? number(100 * p.bias.mean) : "–"), small: (p) => (p.bias ? `± ${number(100 * p.bias.ci95)}` : "") },
];

const errorColumns = [
  choiceColumn,
  numberColumn("MSE", (p) => p.quality.mse, "of the image as displayed, squared steps of a byte"),
  numberColumn("SSIM", (p) => p.quality.ssim),
  numberColumn("PSNR", (p) => 10 * Math.log10(255 ** 2 / p.quality.mse), "dB"),
  numberColumn("FLIP", (p) => p.quality.flip),
  numberColumn("linear MSE", (p) => p.quality.linear_mse),
  numberColumn("relative MSE", (p) => p.quality.relative_mse),
];

const timeColumns = [
  choiceColumn,
  numberColumn("rebuild", (p) => p.build_ms),
  numberColumn("refit", (p) => p.refit_ms),
  numberColumn("update", (p) => p.update_ms, "what a frame waits for by the update policy, on average"),
  numberColumn("image", (p) => p.image_ms),
  numberColumn("frame", (p) => p.update_ms + p.image_ms),
  ratioColumn("frame ×", (p) => p.frame_ratio),
];

const drawTables = () => {
  const rows = scenePoints().map((point, index) => ({ point, index }));
  const shown = rows.filter((row) => !state.axis || row.point.default || row.point.config.axis === state.axis);
  table("all", allColumns, shown);
  table("errors", errorColumns, rows);
  table("times", timeColumns, rows);
};
