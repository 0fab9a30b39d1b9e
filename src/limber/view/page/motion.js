// Motion of one result over time: the processor's twin of what the shaders draw.

/// Interval i and fraction s of a time; clamped to the record.
export function locate(times, t) {
  const last = times.length - 1;
  if (!(t > times[0]) || last === 0) return { i: 0, s: 0, h: 0 };
  if (t >= times[last]) return { i: last, s: 0, h: 0 };
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  const h = times[high] - times[low];
  return { i: low, s: (t - times[low]) / h, h };
}

// Cubic Hermite polynomial.
function hermite(a, b, ra, rb, s, h) {
  const s2 = s * s;
  const s3 = s2 * s;
  return (
    a * (2 * s3 - 3 * s2 + 1) + b * (3 * s2 - 2 * s3) + h * (ra * (s3 - 2 * s2 + s) + rb * (s3 - s2))
  );
}

const mix = (a, b, s) => a + s * (b - a);

function slerp(q, i, s) {
  const a = q.subarray(4 * i, 4 * i + 4);
  if (s === 0) return Array.from(a);
  const b = Array.from(q.subarray(4 * i + 4, 4 * i + 8));
  let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  if (dot < 0) {
    dot = -dot;
    for (let c = 0; c < 4; ++c) b[c] = -b[c];
  }
  const angle = Math.acos(Math.min(1, dot));
  const sine = Math.sin(angle);
  const wa = sine < 1e-6 ? 1 - s : Math.sin((1 - s) * angle) / sine;
  const wb = sine < 1e-6 ? s : Math.sin(s * angle) / sine;
  return [0, 1, 2, 3].map((c) => wa * a[c] + wb * b[c]);
}

/// R v of a quaternion w x y z.
export function rotate(q, v) {
  const [w, x, y, z] = q;
  const a = 2 * (y * v[2] - z * v[1]);
  const b = 2 * (z * v[0] - x * v[2]);
  const c = 2 * (x * v[1] - y * v[0]);
  return [
    v[0] + w * a + y * c - z * b,
    v[1] + w * b + z * a - x * c,
    v[2] + w * c + x * b - y * a,
  ];
}

export const conjugate = (q) => [q[0], -q[1], -q[2], -q[3]];

// Which coordinates have enough outputs in a period for their rates to be of
// use between outputs; the others are joined by straight lines.
function findSmooth(times, body) {
  const m = body.modes ?? 0;
  const smooth = new Array(m).fill(false);
  if (!body.etadot) return smooth;
  let h = 0;
  for (let i = 1; i < times.length; ++i) h = Math.max(h, times[i] - times[i - 1]);
  for (let k = 0; k < m; ++k) {
    let size = 0;
    let rate = 0;
    for (let i = k; i < body.eta.length; i += m) {
      size = Math.max(size, Math.abs(body.eta[i]));
      rate = Math.max(rate, Math.abs(body.etadot[i]));
    }
    smooth[k] = rate * h < 1.5 * size;
  }
  return smooth;
}

export class Motion {
  constructor(result) {
    this.result = result;
    this.times = result.times;
    this.smooth = result.bodies.map((body) => findSmooth(result.times, body));
  }

  /// Where the picture counts from at a time, world [m]: the offset of the
  /// result, or, where it travels far, the mean of its bodies' places. It is
  /// that of src/limber/view/home.hpp at outputs.
  home(at) {
    const { offset, travels, bodies } = this.result;
    if (!travels) return offset;
    const sum = [0, 0, 0];
    bodies.forEach((_, b) => this.pose(b, at).p.forEach((value, c) => (sum[c] += value)));
    return sum.map((value) => value / bodies.length);
  }

  /// Position [m] and quaternion of a body's frame.
  pose(b, at) {
    const { p, v, q } = this.result.bodies[b];
    const { i, s, h } = at;
    const position = [0, 1, 2].map((c) =>
      s === 0
        ? p[3 * i + c]
        : hermite(p[3 * i + c], p[3 * i + 3 + c], v[3 * i + c], v[3 * i + 3 + c], s, h),
    );
    return { p: position, q: slerp(q, i, s) };
  }

  /// Modal coordinates into `out`.
  eta(b, at, out) {
    const body = this.result.bodies[b];
    const m = body.modes ?? 0;
    const { i, s, h } = at;
    for (let k = 0; k < m; ++k) {
      const here = i * m + k;
      if (s === 0) out[k] = body.eta[here];
      else if (this.smooth[b][k]) {
        out[k] = hermite(
          body.eta[here], body.eta[here + m], body.etadot[here], body.etadot[here + m], s, h);
      } else out[k] = mix(body.eta[here], body.eta[here + m], s);
    }
    return out;
  }

  /// Coordinates of a body's stress at a time: the modal ones, or at level `full`
  /// its own, joined by straight lines.
  stressCoordinates(b, at, eta) {
    const { zeta, stress } = this.result.bodies[b];
    if (!zeta) return eta;
    const r = stress.length;
    const { i, s } = at;
    return Float64Array.from(stress, (_, k) =>
      s === 0 ? zeta[i * r + k] : mix(zeta[i * r + k], zeta[(i + 1) * r + k], s));
  }

  /// Modal velocities into `out`; by differences where none were recorded.
  etadot(b, at, out) {
    const body = this.result.bodies[b];
    const m = body.modes ?? 0;
    const { i, s } = at;
    const last = this.times.length - 1;
    for (let k = 0; k < m; ++k) {
      if (body.etadot) {
        const here = i * m + k;
        out[k] = s === 0 ? body.etadot[here] : mix(body.etadot[here], body.etadot[here + m], s);
      } else if (last === 0) out[k] = 0;
      else {
        const from = Math.min(i, last - 1);
        out[k] =
          (body.eta[(from + 1) * m + k] - body.eta[from * m + k]) /
          (this.times[from + 1] - this.times[from]);
      }
    }
    return out;
  }

  /// Velocity [m/s] and angular velocity [rad/s], both in the body frame.
  twist(b, at, pose) {
    const { v, w } = this.result.bodies[b];
    const { i, s } = at;
    const take = (a, c) => (s === 0 ? a[3 * i + c] : mix(a[3 * i + c], a[3 * i + 3 + c], s));
    const velocity = [0, 1, 2].map((c) => take(v, c));
    return { v: rotate(conjugate(pose.q), velocity), w: [0, 1, 2].map((c) => take(w, c)) };
  }

  /// Deformation of a surface's node, body frame [m].
  deformation(b, node, eta) {
    const { shapes } = this.result.surfaces[this.result.bodies[b].surface];
    const u = [0, 0, 0];
    for (let k = 0; k < shapes.length; ++k) {
      for (let c = 0; c < 3; ++c) u[c] += shapes[k][3 * node + c] * eta[k];
    }
    return u;
  }

  /// Position of a surface's node in the world [m], its deformation magnified.
  position(b, node, t, magnification = 1) {
    const at = locate(this.times, t);
    const body = this.result.bodies[b];
    const { x } = this.result.surfaces[body.surface];
    const eta = this.eta(b, at, new Float64Array(body.modes));
    const u = this.deformation(b, node, eta);
    const pose = this.pose(b, at);
    const y = [0, 1, 2].map((c) => x[3 * node + c] + magnification * u[c]);
    return rotate(pose.q, y).map((value, c) => value + pose.p[c]);
  }

  /// Position of an anchor in the world [m].
  anchor({ body, p, shapes }, at, magnification = 1) {
    if (body < 0) return p;
    const m = shapes.length / 3;
    const y = Array.from(p);
    if (m > 0) {
      const eta = this.eta(body, at, new Float64Array(m));
      for (let c = 0; c < 3; ++c) {
        for (let k = 0; k < m; ++k) y[c] += magnification * shapes[c * m + k] * eta[k];
      }
    }
    const pose = this.pose(body, at);
    return rotate(pose.q, y).map((value, c) => value + pose.p[c]);
  }
}

/// A load's factor at a time: linear in a list of times and values, where a
/// time that comes twice is a jump.
export function factorAt(course, t) {
  const n = course.length / 2;
  if (n === 0 || t < course[0]) return 0;
  let low = 0;
  let high = n;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (course[2 * middle] <= t) low = middle;
    else high = middle;
  }
  if (low === n - 1) return course[2 * n - 1];
  const from = course[2 * low];
  const to = course[2 * low + 2];
  return mix(course[2 * low + 1], course[2 * low + 3], to > from ? (t - from) / (to - from) : 0);
}
