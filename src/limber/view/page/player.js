// Time: plays between the ends of an interval, at a speed.

export const kSpeeds = [
  10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 1e-4,
];

export class Player {
  constructor(times) {
    this.times = times;
    this.start = times[0];
    this.end = times[times.length - 1];
    this.from = this.start;
    this.to = this.end;
    this.time = this.start;
    this.isPlaying = false;
    this.listeners = [];
    // The whole in about eight seconds.
    const wanted = (this.end - this.start) / 8;
    this.speed = kSpeeds.find((speed) => speed <= wanted) ?? kSpeeds[kSpeeds.length - 1];
    if (this.end === this.start) this.speed = 1;
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  tell() {
    for (const listener of this.listeners) listener();
  }

  seek(t) {
    this.time = Math.min(this.end, Math.max(this.start, t));
    this.tell();
  }

  play() {
    if (this.time >= this.to || this.time < this.from) this.time = this.from;
    this.isPlaying = this.end > this.start;
    this.tell();
  }

  pause() {
    this.isPlaying = false;
    this.tell();
  }

  toggle() {
    if (this.isPlaying) this.pause();
    else this.play();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.tell();
  }

  faster(steps) {
    const i = kSpeeds.indexOf(this.speed);
    this.setSpeed(kSpeeds[Math.min(kSpeeds.length - 1, Math.max(0, i - steps))]);
  }

  setInterval(from, to) {
    this.from = Math.max(this.start, Math.min(from, to));
    this.to = Math.min(this.end, Math.max(from, to));
    if (!(this.to > this.from)) {
      this.from = this.start;
      this.to = this.end;
    }
    this.tell();
  }

  /// To the next or previous outputs.
  step(count) {
    const { times } = this;
    let i = 0;
    while (i + 1 < times.length && times[i + 1] <= this.time * (1 + 1e-12)) ++i;
    if (count < 0 && times[i] < this.time) ++count;
    this.pause();
    this.seek(times[Math.min(times.length - 1, Math.max(0, i + count))]);
  }

  /// @param seconds of wall time since the last call
  advance(seconds) {
    if (!this.isPlaying) return;
    const length = this.to - this.from;
    let t = this.time + seconds * this.speed;
    if (t > this.to) t = this.from + ((t - this.from) % length);
    this.time = t;
    this.tell();
  }
}
