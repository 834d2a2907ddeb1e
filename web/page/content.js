// content.js - what a page shows: the mesh that it holds, or files dropped on it.

const POINT_FILES = /\.(csv|tsv|txt|xyz|las)(\.gz)?$/i;
const SIDE_FILES = /\.(ele|prj)$/i;

/** The mesh in the page: { mesh, as, query }; null: the page is empty. */
function readContent(meshwalk, text) {
  if (!text.trim().startsWith("{")) return null; // the page as the build made it
  const content = JSON.parse(text);
  const { engine } = meshwalk;
  const doubles = (packed) => new Float64Array(engine.unpack(packed).buffer);
  const fields = (list) =>
    Object.fromEntries(list.map(({ name, values }) => [name, doubles(values)]));
  const mesh = meshwalk.createMesh({
    points: doubles(content.points),
    triangles: new Uint32Array(engine.unpack(content.triangles).buffer),
    dimension: 3,
    name: content.name,
    fields: fields(content.fields),
    triangleFields: fields(content.triangleFields),
  });
  mesh.hasHeights = content.heights;
  mesh.crs = content.crs || null;
  const { query } = content;
  return { mesh, as: content.as, centre: content.centre,
    query: query && { name: query.name, xy: doubles(query.points) } };
}

async function readBytes(file) {
  return new Uint8Array(await new Response(file).arrayBuffer());
}

/** x and y among the columns of a table of points. */
function pointsOf({ columns, width, count, values }) {
  const named = (names) => columns.findIndex((column) => names.includes(column.toLowerCase()));
  let x = named(["x", "lon", "longitude", "easting"]);
  let y = named(["y", "lat", "latitude", "northing"]);
  if (x < 0 || y < 0) [x, y] = [0, 1];
  const xy = new Float64Array(2 * count);
  for (let i = 0; i < count; i++) xy.set([values[i * width + x], values[i * width + y]], 2 * i);
  return xy;
}

/** Open files as they were dropped: one mesh, with what stands beside it, or points. */
async function openFiles(app, files) {
  const bytes = {};
  for (const file of files) bytes[file.name] = await readBytes(file);
  const names = Object.keys(bytes).filter((name) => !SIDE_FILES.test(name));
  if (!names.length)
    throw new Error("an .ele or .prj file says nothing without the file beside it");
  for (const name of names) {
    if (POINT_FILES.test(name)) openPoints(app, name, bytes[name]);
    else app.open(app.meshwalk.readMesh(name, bytes[name], bytes));
  }
}

function openPoints(app, name, bytes) {
  const xy = pointsOf(app.meshwalk.readPoints(name, bytes));
  if (!app.mesh) app.open(app.meshwalk.triangulate(xy, name));
  app.points.show(name, xy);
}
