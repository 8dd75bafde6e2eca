"use strict";
// Draws the scene of a case with Plotly, and moves its movers with a slider.
// It is given data only, and puts texts into the page as text.
globalThis.showView = (() => {
  const COLOURS = ["#1261a0", "#d1520a"];
  const SOLID = "#9fb0bf";
  const POLYGON = "#c2a000";
  const ROUND = 20;
  const RINGS = 10;
  const MARGIN = 2; // metres about what is looked at
  const LOOKS = { way: "look at the whole way", mover: "follow the mover", scene: "look at the whole scene" };
  const BUTTONS = ["toImage", "zoom3d", "pan3d", "orbitRotation", "resetCameraDefault3d"];
  const MESH = { type: "mesh3d", flatshading: true, hoverinfo: "name" };
  const LINES = { type: "scatter3d", mode: "lines", hoverinfo: "skip", showlegend: false };

  const emptyMesh = () => ({ x: [], y: [], z: [], i: [], j: [], k: [], text: [] });

  const addPolygon = (mesh, corners, text) => {
    const first = mesh.x.length;
    for (const [x, y, z] of corners) {
      mesh.x.push(x); mesh.y.push(y); mesh.z.push(z); mesh.text.push(text);
    }
    for (let n = 2; n < corners.length; n += 1) {
      mesh.i.push(first); mesh.j.push(first + n - 1); mesh.k.push(first + n);
    }
  };

  const outline = (polygons) => {
    const line = { x: [], y: [], z: [] };
    for (const corners of polygons) {
      for (const [x, y, z] of [...corners, corners[0]]) {
        line.x.push(x); line.y.push(y); line.z.push(z);
      }
      line.x.push(null); line.y.push(null); line.z.push(null);
    }
    return line;
  };

  const spheres = (rows) => {
    const mesh = emptyMesh();
    for (const [cx, cy, cz, r] of rows) {
      const at = (ring, side) => {
        const up = Math.PI * (ring / RINGS - 0.5);
        const round = (2 * Math.PI * side) / ROUND;
        return [cx + r * Math.cos(up) * Math.cos(round), cy + r * Math.cos(up) * Math.sin(round), cz + r * Math.sin(up)];
      };
      for (let ring = 0; ring < RINGS; ring += 1) {
        for (let side = 0; side < ROUND; side += 1) {
          addPolygon(mesh, [at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)], "");
        }
      }
    }
    return mesh;
  };

  const oneMesh = (corners) => {
    const mesh = emptyMesh();
    if (corners) addPolygon(mesh, corners, "");
    return mesh;
  };

  const scatter = (points) => ({ x: points.map((p) => p[0]), y: points.map((p) => p[1]), z: points.map((p) => p[2]) });

  // What a step shows of one of the two, in the order of `moverTraces`.
  const moverData = (step, who) => {
    const mover = step.same && who === 1 ? null : step.movers[who];
    return [
      spheres(mover?.spheres ?? []),
      oneMesh(mover?.plane),
      outline(mover?.polygon ? [mover.polygon] : []),
      scatter(mover ? [...mover.points, ...(mover.spheres.length ? [] : [mover.position])] : []),
    ];
  };

  const moverTraces = (data, who) => {
    const color = COLOURS[who];
    const name = data.names[who] === data.names[1 - who] ? `${data.names[who]} (${who + 1})` : data.names[who];
    const plain = name.replaceAll("<", "").replaceAll("&", "");
    const [body, plane, polygon, points] = moverData(data.steps[0], who);
    const path = scatter(data.steps.map((step) => step.movers[who]?.position ?? [null, null, null]));
    return [
      { ...MESH, ...body, color, opacity: 0.55, name: `${plain}: spheres`, showlegend: true },
      { ...MESH, ...plane, color, opacity: 0.45, name: `${plain}: contact plane`, showlegend: true },
      { ...LINES, ...polygon, name: `${plain}: polygon`, showlegend: true, line: { color: who ? color : POLYGON, width: 8 } },
      { type: "scatter3d", mode: "markers", ...points, name: `${plain}: points`, hoverinfo: "name+x+y+z", marker: { color, size: 5 }, showlegend: false },
      { ...LINES, mode: "lines+markers", ...path, name: `${plain}: way`, showlegend: true, line: { color, width: 3 }, marker: { color, size: 2 } },
    ];
  };

  const solidTraces = (data) =>
    data.solids.flatMap(({ name, polygons }) => {
      const mesh = emptyMesh();
      polygons.forEach((corners, number) => addPolygon(mesh, corners, `${name}, polygon ${number}`));
      return [
        { ...MESH, ...mesh, color: SOLID, opacity: 0.35, name, hoverinfo: "text" },
        { ...LINES, ...outline(polygons), name, line: { color: "#5c6b7a", width: 2 } },
      ];
    });

  const points = (data, look, number) => {
    const steps = look === "mover" ? [data.steps[number]] : data.steps;
    const found = steps.flatMap((step) => step.movers.filter(Boolean)).flatMap((mover) =>
      mover.spheres.length
        ? mover.spheres.flatMap(([x, y, z, r]) => [[x - r, y - r, z - r], [x + r, y + r, z + r]])
        : [mover.position, ...mover.points]);
    return look !== "scene" && found.length ? found : [...found, ...data.solids.flatMap((solid) => solid.polygons.flat())];
  };

  const ranges = (data, look, number) => {
    const all = points(data, look, number);
    const range = (axis) => {
      let low = Infinity;
      let high = -Infinity;
      for (const point of all) {
        low = Math.min(low, point[axis]);
        high = Math.max(high, point[axis]);
      }
      return [low - MARGIN, high + MARGIN];
    };
    return [range(0), range(1), range(2)];
  };

  const axes = (data, look, number) => {
    const [x, y, z] = ranges(data, look, number);
    const sizes = [x, y, z].map(([low, high]) => high - low);
    const longest = Math.max(...sizes);
    const ratio = { x: sizes[0] / longest, y: sizes[1] / longest, z: sizes[2] / longest };
    return { x, y, z, ratio };
  };

  const layout = (data) => {
    const { x, y, z, ratio } = axes(data, "way", data.at);
    const axis = (title, range) => ({ title: { text: title }, range, autorange: false });
    return {
      margin: { l: 0, r: 0, t: 0, b: 0 },
      legend: { x: 0, y: 1, bgcolor: "rgba(255,255,255,0.7)" },
      uirevision: "kept",
      scene: {
        xaxis: axis("x (m)", x), yaxis: axis("y (m)", y), zaxis: axis("z (m)", z),
        aspectmode: "manual", aspectratio: ratio, camera: { eye: { x: 0.8, y: -1.0, z: 0.6 } },
      },
    };
  };

  const element = (name, properties, ...children) => {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
  };

  const moveTo = (plot, data, first, number) => {
    const step = data.steps[number];
    const updates = [0, 1].flatMap((who) => moverData(step, who));
    const indices = [0, 1].flatMap((who) => [0, 1, 2, 3].map((n) => first + 5 * who + n));
    const keys = ["x", "y", "z", "i", "j", "k"];
    const changes = {};
    for (const key of keys) changes[key] = updates.map((update) => update[key] ?? []);
    return globalThis.Plotly.restyle(plot, changes, indices);
  };

  const controls = (plot, data, first) => {
    const label = element("output", {});
    const text = element("div", { className: "step" });
    const slider = element("input", { type: "range", min: 0, max: data.steps.length - 1, value: 0, ariaLabel: "step" });
    slider.value = String(data.at);
    const choices = Object.entries(LOOKS).map(([value, textContent]) => element("option", { value, textContent }));
    const look = element("select", { ariaLabel: "look" }, ...choices);
    const aim = () => {
      const { x, y, z, ratio } = axes(data, look.value, Number(slider.value));
      return globalThis.Plotly.relayout(plot, {
        "scene.xaxis.range": x, "scene.yaxis.range": y, "scene.zaxis.range": z, "scene.aspectratio": ratio,
      });
    };
    const go = async () => {
      const step = data.steps[Number(slider.value)];
      label.textContent = step.label;
      text.textContent = step.text;
      await moveTo(plot, data, first, Number(slider.value));
      if (look.value === "mover") await aim();
    };
    slider.addEventListener("input", go);
    look.addEventListener("change", aim);
    return { parts: [element("div", { className: "controls" }, slider, label, look), text], go };
  };

  return (view) => {
    if (view.querySelector(".plot")) return;
    const data = JSON.parse(view.querySelector("script").textContent);
    const solids = solidTraces(data);
    const plot = element("div", { className: "plot" });
    const { parts, go } = controls(plot, data, solids.length);
    view.append(plot, ...parts);
    const traces = [...solids, ...moverTraces(data, 0), ...moverTraces(data, 1)];
    const options = { responsive: true, displaylogo: false, modeBarButtons: [BUTTONS] };
    globalThis.Plotly.newPlot(plot, traces, layout(data), options).then(go).then(() => {
      view.dataset.drawn = "true";
    });
  };
})();
