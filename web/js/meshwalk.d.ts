// meshwalk.d.ts - the interface of the engine in a browser and in Node.js.
//
//   const meshwalk = await loadMeshwalk(bytesOfTheModule);
//   const mesh = meshwalk.readMesh("terrain.ply", bytes);
//   const locator = meshwalk.createLocator(mesh);
//   const { where, triangle, weights } = locator.locateOne(15000, 16000);
//
// Answers are those of the C library, bit for bit. There are no threads. Memory of the engine is
// not collected: release locators and meshes with free(), locators first.

export type Where = "inside" | "edge" | "vertex" | "outside" | "hole" | "near" | "bad";
export type Stage = "init" | "walk" | "final" | "border";
export type Status = "argument" | "input" | "memory" | "limit" | "system";
export type DefectKind =
  | "index" | "not-finite" | "repeated-vertex" | "edge-shared" | "folded" | "turn" | "crossing"
  | "vertex-in-edge" | "overlap" | "flat" | "clashing" | "open-edge" | "through-centre"
  | "turned" | "covered";

/** What a call refused. The places are null where they do not apply; lines count from 1. */
export class MeshwalkError extends Error {
  status: Status;
  triangle: number | null;
  vertex: number | null;
  line: number | null;
}

/** One defect and where it is; members that do not apply are null. */
export interface Defect {
  kind: DefectKind;
  triangle: number | null;
  other: number | null;
  vertex: number | null;
  edge: number | null;
  otherEdge: number | null;
  /** The sentence that `meshwalk check` prints. */
  text: string;
}

/** The names of DefectKind, in the order of mw_defect_kind. */
export const DEFECT_KINDS: DefectKind[];

/** Counts and properties of a planar mesh: mw_mesh_info. */
export interface MeshInfo {
  vertices: number;
  triangles: number;
  unusedVertices: number;
  flatTriangles: number;
  clockwiseTriangles: number;
  clashingEdges: number;
  borderEdges: number;
  borderLoops: number;
  components: number;
  holes: number;
  oriented: boolean;
  embedding: boolean;
  convex: boolean;
  delaunay: boolean;
  low: [number, number];
  high: [number, number];
  area: number;
}

/** A mesh of triangles. Arrays are views of the engine's memory: copy what you keep. */
export class Mesh {
  readonly name: string;
  readonly vertexCount: number;
  readonly triangleCount: number;
  readonly hasHeights: boolean;
  /** WKT or "EPSG:n"; null: not known. */
  readonly crs: string | null;
  /** x, y, z of each vertex. */
  readonly points: Float64Array;
  /** Three vertices of each triangle. */
  readonly triangles: Uint32Array;
  readonly fieldNames: string[];
  readonly triangleFieldNames: string[];
  /** A value of each vertex; null if there is no such field. */
  field(name: string): Float64Array | null;
  /** A value of each triangle; null if there is no such field. */
  triangleField(name: string): Float64Array | null;
  /** Across edges 0, 1, 2 of each triangle: 4 * neighbour + its edge; 4294967295 on a border. A
   * copy. */
  links(): Uint32Array;
  /** Throws if the arrays are unusable: check() tells why. */
  describe(): MeshInfo;
  /** Every defect: as a mesh of the plane, as a surface, or as a star about a centre. */
  check(as?: "plane" | "surface" | "star", centre?: Point): { valid: boolean; defects: Defect[] };
  /** Release the memory. Free its locators before. */
  free(): void;
}

/** Where one point lies. */
export interface Location {
  where: Where;
  triangle: number | null;
  /** Local edge on an edge, local vertex at a vertex. */
  local: number | null;
  hole: number | null;
  /** Barycentric weights of the triangle's vertices; NaN without a triangle. */
  weights: number[];
}

/** Where many points lie, one array a member. */
export class Locations {
  readonly length: number;
  /** Numbers of Locations.names. */
  readonly where: Uint8Array;
  /** 4294967295: none. */
  readonly triangle: Uint32Array;
  readonly hole: Uint32Array;
  /** 255: none. */
  readonly local: Uint8Array;
  /** Three for each point. */
  readonly weights: Float64Array;
  static readonly names: Where[];
}

export interface LocatorOptions {
  /** Take a mesh that is no embedding; see voidPromise. */
  any?: boolean;
  /** Build what nearestBorder() and tolerances need. */
  border?: boolean;
  /** Whether pockets and holes are filled: the border walk wants them open, others filled. */
  fill?: "auto" | "filled" | "open";
}

export interface QueryOptions {
  /** A name of Meshwalk.walks, or "auto". Answers do not depend on it. */
  walk?: string;
  /** A name of Meshwalk.starts, or "auto". */
  start?: string;
  seed?: number;
  /** Points outside, at most this far from the mesh, are "near". Needs { border: true }. */
  tolerance?: number;
}

/** What a walk did. */
export interface Counters {
  visited: number;
  orientations: number;
  implicit: number;
  comparisons: number;
  /** Walks that ran out of steps: in a ring, or on a long way in a thin mesh. */
  cycles: number;
  /** Walks that one with a proof of its end had to finish. */
  handovers: number;
}

/** One walk, as it went. */
export interface Walk {
  triangles: Uint32Array;
  stages: Stage[];
  location: Location;
  counters: Counters;
  /** The line that the walk follows: no points, 2, or 3 of two legs. */
  line: [number, number][];
}

/** A mesh prepared for queries. */
export class Locator {
  readonly mesh: Mesh;
  /** The promise that does not hold because the mesh is no embedding; null: all hold. */
  readonly voidPromise: string | null;
  /** Locate points x, y, x, y, ... */
  locate(points: ArrayLike<number>, options?: QueryOptions): Locations;
  locateOne(x: number, y: number, options?: QueryOptions): Location;
  /** Values of vertices, interpolated; NaN where there is no triangle. */
  interpolate(values: ArrayLike<number>, locations: Locations): Float64Array;
  /** The triangles along a segment, in order, with parameters from 0 at `a` to 1 at `b`. */
  segment(a: [number, number], b: [number, number]):
    { from: number; to: number; triangle: number }[];
  nearestBorder(x: number, y: number):
    { triangle: number; edge: number; distance: number; point: [number, number] };
  /** Walk from the triangle that contains `from` to the point `to`. */
  follow(from: [number, number], to: [number, number], options?: { walk?: string; seed?: number }):
    Walk;
  free(): void;
}

export type Point = [number, number, number];

/** What a probe or a ray met, and the triangles that its walk visited. */
export interface Touch {
  triangles: Uint32Array;
  /** Of each triangle the number of its walk: a probe may take several. */
  iterations: Uint32Array;
  /** "none": for certain; "limit": nothing was found, but there may be something. */
  state: "hit" | "none" | "limit" | "bad";
  triangle: number | null;
  where: Where;
  local: number | null;
  weights: number[];
  /** Of a probe: along its motion. */
  distance: number;
}

/** A mesh taken as a surface in space. */
export class Surface {
  probe(point: Point, motion: Point, options?: { certain?: boolean; seed?: number }): Touch;
  /** Rays come from here; throws if the surface is not star-shaped about it. */
  setCentre(centre: Point): void;
  /** Walk from the ray through `from` to the ray through `to`. */
  followRay(from: Point, to: Point, options?: { walk?: string; seed?: number }):
    Touch & { counters: Counters };
  free(): void;
}

export type Colour = [number, number, number];

/** Lines in a picture in space; what lies behind a triangle is not seen. */
export interface Lines {
  ink: Colour;
  /** Width of edges in pixels; 0: none. */
  edge?: number;
  /** Width of edges on borders; 0: as other edges. */
  border?: number;
  /** How much of the ink edges take, 0 to 1. */
  alpha?: number;
  /** No edges if more triangles than these have a part in the picture. */
  most?: number;
}

/** A picture of a mesh, drawn into pixels. */
export class Picture {
  constructor(mesh: Mesh);
  resize(width: number, height: number): void;
  /** Colours of values from low to high (256), of missing values, and of a mesh without values. */
  setPalette(colours: Colour[], missing: Colour, plain: Colour): void;
  setValues(values: ArrayLike<number> | null, ofTriangles: boolean, low: number, high: number):
    void;
  setLight(direction: [number, number, number] | null, inSpace: boolean, lift?: number): void;
  /** Which edges are on borders, for pictures in space: those whose link is 4294967295, as
   * Mesh.links() tells. */
  setBorders(links: Uint32Array): void;
  /** Three rows of four: pixel x, pixel y, depth from x, y, z, 1. Returns red, green, blue, alpha
   * of each pixel. */
  draw(matrix: number[], inSpace: boolean, lines?: Lines): Uint8ClampedArray;
  /** How many triangles have a part in the last picture. */
  readonly visible: number;
  list(most: number): Uint32Array;
  /** The triangle drawn at a pixel; null: none. */
  triangleAt(x: number, y: number): number | null;
  free(): void;
}

/** Points of a file: `width` values for each. */
export interface Points {
  columns: string[];
  width: number;
  count: number;
  values: Float64Array;
}

/** The engine. */
export class Meshwalk {
  readonly version: string;
  readonly walks: { name: string; source: string; help: string }[];
  readonly starts: { name: string; help: string }[];
  readonly starWalks: { name: string; source: string; help: string }[];
  /** Read a mesh of any format that the library reads without other libraries; also packed by gzip.
   * `beside`: further files by name, such as the .ele of a .node, or a .prj. */
  readMesh(name: string, bytes: Uint8Array, beside?: Record<string, Uint8Array>): Mesh;
  readPoints(name: string, bytes: Uint8Array): Points;
  /** The pairs of columns that may be x and y by their names (x and y, lon and lat, easting and
   * northing, ...), and whether any of the names means a coordinate. */
  coordinateColumns(columns: string[]): { fits: [number, number][]; known: boolean };
  createMesh(arrays: {
    points: ArrayLike<number>;
    triangles: ArrayLike<number>;
    /** 2: x, y; 3: x, y, z. */
    dimension?: 2 | 3;
    name?: string;
    fields?: Record<string, ArrayLike<number>>;
    triangleFields?: Record<string, ArrayLike<number>>;
  }): Mesh;
  /** The Delaunay triangulation of points x, y. */
  triangulate(points: ArrayLike<number>, name?: string): Mesh;
  /** The side of the line from a to b that c is on, exactly: 1 left, -1 right, 0 on it. */
  orient2d(a: ArrayLike<number>, b: ArrayLike<number>, c: ArrayLike<number>): number;
  createSurface(mesh: Mesh, options?: { weld?: boolean }): Surface;
  createLocator(mesh: Mesh, options?: LocatorOptions): Locator;
}

/** Load the engine from the bytes of meshwalk.wasm, or from a compiled module. */
export function loadMeshwalk(bytes: BufferSource | WebAssembly.Module): Promise<Meshwalk>;
