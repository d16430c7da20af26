// Draws the page's charts by Chart.js from the data that the page carries. Texts of documents only ever become text nodes.
"use strict";
(() => {
  const {charts, abscissas} = JSON.parse(document.getElementById("charts").textContent);
  charts.forEach((chart) => chart.curves.forEach((curve) => { curve.x = abscissas[curve.x]; }));

  const shown = (value) => {
    if (typeof value !== "number") return value === null || value === undefined ? "none" : String(value);
    if (value === 0) return "0";
    const size = Math.abs(value);
    return size >= 1e6 || size < 1e-3 ? value.toExponential(3).replace(/\.?0+e/, "e") : String(+value.toPrecision(6));
  };
  const lines = (pairs) => pairs.filter(([, value]) => value !== null && value !== undefined)
    .map(([name, value]) => `${name}: ${shown(value)}`);

  const scale = (axis, horizontal) => ({
    type: axis.log ? "logarithmic" : "linear",
    position: horizontal ? "bottom" : "left",
    min: axis.min, max: axis.max, offset: false,
    title: {display: true, text: axis.label},
    grid: {color: "#e3e6e8", offset: false},
    ticks: {
      maxRotation: 0, autoSkipPadding: 12, includeBounds: false,
      callback: (value) => {
        if (!axis.log) return shown(value);
        const power = Math.log10(value);
        if (Math.abs(power - Math.round(power)) < 1e-9) return shown(value);
        // Between the powers of ten only where an axis spans few of them.
        const lead = value / 10 ** Math.floor(power + 1e-9);
        return axis.max && axis.max / axis.min < 2000 && [2, 5].includes(+lead.toPrecision(3)) ? shown(value) : "";
      },
    },
  });

  const more = (curve, i) => (curve.hover || []).map(([name, values]) => [name, values[i]]);

  // What comes first is drawn last, so the order says: cells below, then the curves one above the other, points on top.
  const curveData = (chart, curve, index) => ({
    type: "line",
    label: curve.name,
    data: curve.x.map((x, i) => ({x, y: curve.y[i], at: i})),
    borderColor: curve.colour, backgroundColor: curve.hollow ? "transparent" : curve.colour,
    borderWidth: curve.hollow ? 2 : curve.width || 1.5, borderDash: curve.line ? curve.dash : [],
    showLine: curve.line, spanGaps: false,
    // A phase that goes out at the top and comes in at the bottom has no line between.
    segment: curve.wrap ? {borderColor: ({p0, p1}) => Math.abs(p1.parsed.y - p0.parsed.y) > curve.wrap ? "transparent" : undefined} : undefined,
    pointStyle: curve.points ? curve.shape : "line", pointRadius: curve.points ? curve.radius || 3 : 0,
    pointHoverRadius: (curve.points ? curve.radius || 3 : 0) + 2, pointHitRadius: 4,
    clip: curve.points ? 12 : 0,
    order: (curve.points && !curve.line ? 0 : 1000) - index,
    quiet: curve.quiet,
    hoverLines: (i) => [curve.name].concat(lines([[chart.x.label, curve.x[i]], [chart.y.label, curve.y[i]]].concat(more(curve, i)))),
    hoverLine: (i) => lines([[curve.name, curve.y[i]]].concat(more(curve, i))).join(", "),
  });

  // A cell is a floating bar; one data set for each step of colour.
  const cellData = (chart, cells) => {
    const edge = (i) => {
      const y = cells.y;
      if (y.length < 2) return i === 0 ? chart.y.min ?? y[0] - 0.5 : chart.y.max ?? y[0] + 0.5;
      const half = i === 0 ? y[1] - y[0] : i === y.length ? y[i - 1] - y[i - 2] : 0;
      return i === 0 ? y[0] - half / 2 : i === y.length ? y[i - 1] + half / 2 : (y[i - 1] + y[i]) / 2;
    };
    const edges = Array.from({length: cells.y.length + 1}, (_, i) => edge(i));
    const sets = cells.colours.map((colour, step) => ({
      type: "bar", label: cells.steps[step], data: [], backgroundColor: colour, hoverBackgroundColor: colour, borderWidth: 0, grouped: false,
      // As wide as the grid's step: by itself a bar is no wider than the distance of two ticks.
      barThickness: (context) => {
        const x = context.chart.scales.x;
        return cells.x.length < 2 ? x.width : Math.abs(x.getPixelForValue(cells.x[1]) - x.getPixelForValue(cells.x[0]));
      },
      borderSkipped: false, pointStyle: "rect", order: 2000, quiet: !cells.steps[step],
      hoverLines: (i, set) => {
        const [column, row] = set.data[i].cell;
        return lines([[chart.x.label, cells.x[column]], [chart.y.label, cells.y[row]], [cells.name, cells.rows[row][column]]]
          .concat(cells.hover.map(([name, values]) => [name, values[column]])));
      },
    }));
    cells.rows.forEach((row, j) => row.forEach((value, i) => {
      if (value === null) return;
      let step = 0;
      while (step < cells.edges.length && value >= cells.edges[step]) ++step;
      sets[step].data.push({x: cells.x[i], y: [edges[j], edges[j + 1]], cell: [i, j]});
    }));
    return sets.filter((set) => set.data.length > 0);
  };

  // The hover text stands in the page, where a screen reader and a test find it.
  const hover = (box) => ({chart, tooltip}) => {
    if (tooltip.opacity === 0 || !tooltip.dataPoints) { box.hidden = true; return; }
    const items = tooltip.dataPoints.slice(0, 8);
    // One point in full; of several at one abscissa a line each.
    const told = items.length === 1 || items.some(({dataset}) => !dataset.hoverLine)
      ? [items[0]].map(({dataset, dataIndex}) => dataset.hoverLines(dataIndex, dataset))
      : [lines([[chart.scales.x.options.title.text, items[0].raw.x]]).concat(items.map(({dataset, dataIndex}) => dataset.hoverLine(dataIndex)))];
    box.replaceChildren(...told.map((of_one) => {
      const part = document.createElement("p");
      of_one.forEach((line, i) => { if (i) part.append(document.createElement("br")); part.append(line); });
      return part;
    }));
    box.hidden = false;
    const left = tooltip.caretX + 14;
    box.style.top = `${Math.max(0, tooltip.caretY - 10)}px`;
    if (left + box.offsetWidth > chart.width) box.style.left = `${Math.max(0, tooltip.caretX - 14 - box.offsetWidth)}px`;
    else box.style.left = `${left}px`;
  };

  Chart.defaults.animation = false;
  Chart.defaults.font.family = "'DejaVu Sans', Arial, sans-serif";
  Chart.defaults.color = "#222222";
  const draw = (canvas) => {
    const start = performance.now();
    const chart = charts[+canvas.dataset.chart];
    const x = {...chart.x}, y = {...chart.y};
    const cells = chart.cells;
    if (cells && cells.x.length > 1) {
      const half = (values) => (values[1] - values[0]) / 2;
      if (x.min === undefined) { x.min = cells.x[0] - half(cells.x); x.max = cells.x.at(-1) + half(cells.x); }
      if (y.min === undefined && cells.y.length > 1) { y.min = cells.y[0] - half(cells.y); y.max = cells.y.at(-1) + half(cells.y); }
    }
    const datasets = chart.curves.map((curve, index) => curveData(chart, curve, index)).concat(cells ? cellData(chart, cells) : []);
    const points = cells || chart.curves.some((curve) => curve.points);
    const drawn = new Chart(canvas, {
      data: {datasets},
      options: {
        maintainAspectRatio: false,
        // Of lines alone the nearest abscissa is told, wherever the pointer is.
        interaction: points ? {mode: "nearest", intersect: true} : {mode: "nearest", axis: "x", intersect: false},
        scales: {x: scale(x, true), y: scale(y, false)},
        plugins: {
          legend: {position: "bottom", labels: {sort: (a, b) => a.datasetIndex - b.datasetIndex, usePointStyle: true, boxHeight: 9, pointStyleWidth: 13, filter: (item, data) => !data.datasets[item.datasetIndex].quiet}},
          tooltip: {enabled: false, itemSort: (a, b) => a.datasetIndex - b.datasetIndex, external: hover(canvas.parentElement.querySelector(".hover"))},
        },
      },
    });
    if (chart.equal) {
      const span = (name) => drawn.scales[name].max - drawn.scales[name].min;
      const {width, height} = drawn.chartArea;
      const ratio = span("y") / span("x");
      const wide = Math.min(width, 800 / ratio);
      canvas.parentElement.style.width = `${drawn.width - width + wide}px`;
      canvas.parentElement.style.height = `${drawn.height - height + wide * ratio}px`;
      drawn.resize();
    }
    performance.measure(`chart ${canvas.dataset.chart}`, {start});
  };
  // Each chart when it comes into sight, so that a long page is there at once; all of them for paper.
  const waiting = new Set(document.querySelectorAll("canvas[data-chart]"));
  const once = (canvas) => { if (waiting.delete(canvas)) draw(canvas); };
  const watcher = new IntersectionObserver((entries) => entries.forEach((entry) => {
    if (entry.isIntersecting) { watcher.unobserve(entry.target); once(entry.target); }
  }), {rootMargin: "200px"});
  waiting.forEach((canvas) => watcher.observe(canvas));
  window.addEventListener("beforeprint", () => [...waiting].forEach(once));
})();
