// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
// Exact arithmetic. Positions are whole numbers of 2^-16 pixels (BigInt), so an edge function is a whole number of 2^-32
// square pixels: nothing is ever rounded.

const POSITION_BITS = 16n;
const ONE = 1n << POSITION_BITS;
const abs = (value) => value < 0n ? -value : value;

// numerator / 2^bits in lowest terms: "3", "-5/256".
function fractionText(numerator, bits) {
  let shift = BigInt(bits);
  while (shift > 0n && (numerator & 1n) === 0n) { numerator >>= 1n; --shift; }
  const text = (numerator < 0n ? "\u2212" : "") + abs(numerator);
  return shift === 0n ? text : text + "/" + (1n << shift);
}
// The same as a decimal fraction if that is short, which it is for coordinates: "3.5", else p/q.
function coordinateText(value) {
  const whole = abs(value) >> POSITION_BITS, part = abs(value) & (ONE - 1n);
  const sign = value < 0n ? "\u2212" : "";
  if (part === 0n) { return sign + whole; }
  const digits = (part * 10n ** 16n / ONE).toString().padStart(16, "0").replace(/0+$/, "");
  return digits.length <= 4 ? sign + whole + "." + digits : fractionText(value, 16);
}
const pointText = (p) => "(" + coordinateText(p.x) + ", " + coordinateText(p.y) + ")";

// E_ab(p): twice the signed area of a, b, p; positive inside a triangle whose area is positive (Vulkan specification, "Basic
// Polygon Rasterization"; Pineda 1988). Unit 2^-32 square pixels.
const edgeFunction = (a, b, p) => (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);

// An edge a -> b of a triangle of positive area (y down: clockwise on screen), as the top-left rule calls it.
function edgeKind(a, b) {
  if (a.y === b.y) { return b.x > a.x ? "top" : "bottom"; }
  return b.y < a.y ? "left" : "right";
}
const ownsTies = (kind) => kind === "top" || kind === "left";

const scratch = new DataView(new ArrayBuffer(4));
function floatOf(bits) {
  scratch.setUint32(0, bits);
  return scratch.getFloat32(0);
}
function bitsOf(value) {
  scratch.setFloat32(0, value);
  return scratch.getUint32(0);
}
const hex = (bits) => "0x" + bits.toString(16).padStart(8, "0");

// Binary32 numbers counted from -infinity to infinity, so that neighbours differ by one and both zeros are one number.
const ordinal = (bits) => bits & 0x80000000 ? -(bits & 0x7fffffff) : bits;
// How many steps of binary32 lie between a number (bits) and the binary32 nearest to `exact`; null if either is no number.
function ulps(bits, exact) {
  const got = floatOf(bits), nearest = Math.fround(exact);
  if (Number.isNaN(got) || Number.isNaN(nearest)) { return null; }
  return Math.abs(ordinal(bits) - ordinal(bitsOf(nearest)));
}

// Numbers for people.
const MINUS = /^-/;
function shortNumber(value, digits = 9) {
  if (value === "inf" || value === Infinity) { return "infinity"; }
  if (value === "-inf" || value === -Infinity) { return "\u2212infinity"; }
  const number = Number(value);
  if (Number.isNaN(number)) { return "NaN"; }
  return String(Number(number.toPrecision(digits))).replace(MINUS, "\u2212");
}
const floatText = (bits) => {
  const value = floatOf(bits);
  return Object.is(value, -0) ? "\u22120" : shortNumber(value);
};
const numberOf = (value) => value === "inf" ? Infinity : value === "-inf" ? -Infinity : value === "nan" ? NaN : Number(value);
