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

/** The columns of x and y of a table; an error if they are not clear, as in `locate`. */
function axesOf(meshwalk, name, columns) {
  const { fits, known } = meshwalk.coordinateColumns(columns);
  const unnamed = columns.every((column, i) => column === (["x", "y", "z"][i] || `c${i + 1}`));
  if (unnamed && (columns.length <= 3 || /\.(xyz|las)(\.gz)?$/i.test(name))) return [0, 1];
  if (fits.length === 1 && !unnamed) return fits[0];
  if (!fits.length && !known && columns.length <= 3) return [0, 1];
  const named = fits.slice(0, 2).map((pair) => pair.map((i) => columns[i]).join());
  const doubt = unnamed ? " They have no names"
    : `${named.length > 1 ? ` Both ${named.join(" and ")} fit.` : ""} They are: ` +
      columns.join(", ");
  throw new Error(`${name}: which of its columns are x,y?${doubt}; ` +
    "'meshwalk view --points FILE --columns LIST' takes any");
}

/** The points of a table, and the names of their columns. */
function pointsOf(meshwalk, name, { columns, width, count, values }) {
  const [x, y] = axesOf(meshwalk, name, columns);
  const xy = new Float64Array(2 * count);
  for (let i = 0; i < count; i++) xy.set([values[i * width + x], values[i * width + y]], 2 * i);
  return { xy, axes: [columns[x], columns[y]] };
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
  const { xy, axes } = pointsOf(app.meshwalk, name, app.meshwalk.readPoints(name, bytes));
  if (!app.mesh) app.open(app.meshwalk.triangulate(xy, name));
  app.points.show(name, xy, axes);
}
