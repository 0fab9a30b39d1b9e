// Order of triangles in which neighbours follow each other, so that a vertex is
// computed once for most triangles around it: a software renderer is twice as
// fast. Source: Sander, Nehab, Barczak, Fast triangle reordering, 2007 (Tipsify).

const kCache = 14; // vertices that a renderer keeps

// Triangles around each vertex: those of v are list[start[v]] to list[start[v + 1]].
function findFans(triangles, vertices) {
  const start = new Uint32Array(vertices + 1);
  for (const v of triangles) ++start[v + 1];
  for (let v = 0; v < vertices; ++v) start[v + 1] += start[v];
  const list = new Uint32Array(triangles.length);
  const next = start.slice();
  triangles.forEach((v, i) => (list[next[v]++] = Math.floor(i / 3)));
  return { start, list };
}

/// The same triangles in another order.
export function orderTriangles(triangles, vertices) {
  const { start, list } = findFans(triangles, vertices);
  const left = new Uint32Array(vertices);
  for (let v = 0; v < vertices; ++v) left[v] = start[v + 1] - start[v];
  const stamp = new Uint32Array(vertices);
  const done = new Uint8Array(triangles.length / 3);
  const out = new Uint32Array(triangles.length);
  const recent = [];
  let clock = kCache + 1;
  let at = 0;
  let scan = 0;

  // The vertex of a fan that is in the cache longest and still will be.
  const pick = (fan) => {
    let best = -1;
    let most = -1;
    for (const v of fan) {
      if (left[v] === 0) continue;
      const age = clock - stamp[v];
      const value = age + 2 * left[v] <= kCache ? age : 0;
      if (value > most) [most, best] = [value, v];
    }
    return best;
  };
  const restart = () => {
    while (recent.length > 0) {
      const v = recent.pop();
      if (left[v] > 0) return v;
    }
    while (scan < vertices && left[scan] === 0) ++scan;
    return scan < vertices ? scan : -1;
  };

  for (let v = restart(); v >= 0; ) {
    const fan = [];
    for (let k = start[v]; k < start[v + 1]; ++k) {
      const triangle = list[k];
      if (done[triangle]) continue;
      done[triangle] = 1;
      for (let c = 0; c < 3; ++c) {
        const corner = triangles[3 * triangle + c];
        out[at++] = corner;
        recent.push(corner);
        fan.push(corner);
        --left[corner];
        if (clock - stamp[corner] > kCache) stamp[corner] = clock++;
      }
    }
    v = pick(fan);
    if (v < 0) v = restart();
  }
  return out;
}
