// Particles that a flow in time carries, and where they were.
import type { Smoke, SmokeMoment } from '../../../model/wind';

export const particles = 6000;
/** Of each: so many places where it was, this far apart in time: in longest sides of the mesh, over the speed of the wind. */
export const pasts = 8;
const pastGap = 0.042;
/** They begin where the wind would come this close to the box of the mesh, in longest sides. */
const closeness = 0.1;
/** In longest sides: how far ahead of the mesh they begin, and how far behind it they are at first. */
const before = 0.38;
const behind = 1.35;
/** The longest that they are drawn, in longest sides over the speed of the wind. */
export const longestLife = 6;
/** What is slower, in speeds of the wind, is in a body. */
const rest = 1e-4;
/** Of a cell: how far particles go in one step. */
const longestStep = 0.5;

export class Tracer {
  /** 4 per particle: where it is, less the smoke's origin, and its speed. */
  readonly head = new Float32Array(4 * particles);
  /** 2 per particle: since when it is there, and how far its velocity is from that of the wind. */
  readonly course = new Float32Array(2 * particles);
  /** 3 per particle, at `pastTime` and at multiples of `gap` before: a ring, whose newest is `newest`. */
  readonly past = Array.from({ length: pasts }, () => new Float32Array(3 * particles));
  newest = 0;
  pastTime: number;
  readonly gap: number;
  private time: number;
  private readonly field: Float32Array;
  private readonly found = new Float32Array(3);
  private seed = 1;
  private written = new Set<number>();

  constructor(private readonly smoke: Smoke) {
    const { begin, size } = smoke;
    this.field = begin.velocity.slice();
    this.gap = pastGap * size;
    this.time = this.pastTime = begin.time;
    for (let particle = 0; particle < particles; particle++) {
      this.place(particle, this.random() * (2 * this.reach() + (before + behind) * size));
      this.course[2 * particle] = begin.time - this.random() * longestLife * size;
    }
    for (const past of this.past) this.remember(past);
  }

  /** Carries them on to a moment of the flow. */
  advance({ from, to, share, time }: SmokeMoment): void {
    for (let at = 0; at < this.field.length; at++) this.field[at] = from.velocity[at] + share * (to.velocity[at] - from.velocity[at]);
    const steps = Math.ceil((time - this.time) / (longestStep * this.smoke.side));
    const step = (time - this.time) / steps;
    for (let count = 0; count < steps; count++) {
      this.time += step;
      this.carry(step);
      if (this.time < this.pastTime + this.gap) continue;
      this.pastTime += this.gap;
      this.newest = (this.newest + 1) % pasts;
      this.remember(this.past[this.newest]);
      this.written.add(this.newest);
    }
  }

  /** The places in the ring that are new since this was asked last. */
  takeWritten(): Set<number> {
    const { written } = this;
    this.written = new Set();
    return written;
  }

  /** How much of the gap has passed since the newest past, 0 to 1. */
  get sincePast(): number {
    return (this.time - this.pastTime) / this.gap;
  }

  get now(): number {
    return this.time;
  }

  /** By the midpoint rule. */
  private carry(step: number): void {
    const { head, course, found, smoke } = this;
    const [windX, windY, windZ] = smoke.direction;
    const oldest = this.time - longestLife * smoke.size;
    for (let particle = 0; particle < particles; particle++) {
      const at = 4 * particle;
      const [x, y, z] = [head[at], head[at + 1], head[at + 2]];
      const isIn = this.find(x, y, z) && this.find(x + 0.5 * step * found[0], y + 0.5 * step * found[1], z + 0.5 * step * found[2]);
      const speed = Math.hypot(found[0], found[1], found[2]);
      if (!isIn || speed < rest || course[2 * particle] < oldest) {
        this.place(particle, 0);
        course[2 * particle] = this.time;
        continue;
      }
      for (let d = 0; d < 3; d++) head[at + d] += step * found[d];
      head[at + 3] = speed;
      course[2 * particle + 1] = Math.hypot(found[0] - windX, found[1] - windY, found[2] - windZ);
    }
  }

  /** Puts the particle so far behind where they begin. */
  private place(particle: number, along: number): void {
    const { half, size, direction } = this.smoke;
    const aside = half.map((x) => (2 * this.random() - 1) * (x + closeness * size));
    const is = aside.reduce((sum, x, d) => sum + x * direction[d], 0);
    const to = along - this.reach() - before * size;
    for (let d = 0; d < 3; d++) this.head[4 * particle + d] = aside[d] + (to - is) * direction[d];
    this.head[4 * particle + 3] = 1;
  }

  /** From the middle of the mesh's box to its end along the wind. */
  private reach(): number {
    return this.smoke.half.reduce((sum, x, d) => sum + x * Math.abs(this.smoke.direction[d]), 0);
  }

  private remember(past: Float32Array): void {
    for (let particle = 0; particle < particles; particle++) {
      for (let d = 0; d < 3; d++) past[3 * particle + d] = this.head[4 * particle + d];
    }
  }

  /** Finds the velocity at a place, linear between the middles of cells; whether it is in the box. */
  private find(x: number, y: number, z: number): boolean {
    const { corner, side, counts } = this.smoke;
    const [u, v, w] = [(x - corner[0]) / side, (y - corner[1]) / side, (z - corner[2]) / side];
    if (!(u >= 0 && v >= 0 && w >= 0 && u < counts[0] && v < counts[1] && w < counts[2])) return false;
    const [i, a] = between(u, counts[0]);
    const [j, b] = between(v, counts[1]);
    const [k, c] = between(w, counts[2]);
    const [stride, layer] = [3 * counts[0], 3 * counts[0] * counts[1]];
    const [one, other] = [counts[0] > 1 ? 3 : 0, counts[1] > 1 ? stride : 0];
    const first = 3 * i + stride * j + layer * k;
    const last = first + (counts[2] > 1 ? layer : 0);
    const { field, found } = this;
    for (let d = 0; d < 3; d++) {
      const near = mix(
        mix(field[first + d], field[first + one + d], a),
        mix(field[first + other + d], field[first + other + one + d], a),
        b,
      );
      const far = mix(mix(field[last + d], field[last + one + d], a), mix(field[last + other + d], field[last + other + one + d], a), b);
      found[d] = mix(near, far, c);
    }
    return true;
  }

  /** 0 to 1, the same each time: Lehmer's. */
  private random(): number {
    this.seed = (this.seed * 48271) % 2147483647;
    return this.seed / 2147483647;
  }
}

const mix = (a: number, b: number, share: number) => a + share * (b - a);

/** The cell whose middle comes before a place, and the share of the next one. */
function between(place: number, count: number): [number, number] {
  const cell = Math.max(0, Math.min(count - 2, Math.floor(place - 0.5)));
  return [cell, Math.max(0, Math.min(1, place - 0.5 - cell))];
}
