// palette.js - colours. All palettes are read by people who are colour-blind: lightness grows.

const ANCHORS = {
  viridis: ["440154", "472d7b", "3b528b", "2c728e", "21918c", "28ae80", "5ec962", "addc30",
    "fde725"],
  cividis: ["00224e", "123570", "3b496c", "575d6d", "707173", "8a8678", "a59c74", "c3b369",
    "e1cc55", "fee838"],
  "blue to orange": ["08306b", "2171b5", "6baed6", "c6dbef", "f5f5f0", "fdd0a2", "fd8d3c",
    "d94801", "7f2704"],
  grey: ["1a1a1a", "f5f5f5"],
};

/** Distinct colours for people who are colour-blind [Okabe, Ito 2008]. */
const STATUS_COLOURS = {
  inside: "#009e73", edge: "#56b4e9", vertex: "#0072b2", outside: "#d55e00", hole: "#cc79a7",
  near: "#e69f00", bad: "#777777",
};

const channels = (hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16));

/** 256 colours of a palette. */
function makePalette(name) {
  const anchors = ANCHORS[name].map(channels);
  return Array.from({ length: 256 }, (_, i) => {
    const at = (i / 255) * (anchors.length - 1);
    const low = Math.min(Math.floor(at), anchors.length - 2);
    return [0, 1, 2].map((k) =>
      Math.round(anchors[low][k] + (at - low) * (anchors[low + 1][k] - anchors[low][k])));
  });
}

/** The colour of a style's variable, such as --mesh, as [red, green, blue]. */
function styleColour(name) {
  const value = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return channels(value.slice(1));
}

function styleText(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
