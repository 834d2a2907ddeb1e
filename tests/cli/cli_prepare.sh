#!/usr/bin/env bash
# prepare: a mesh in a file that is ready for queries; each command takes it as a mesh.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"

# Nine cells without the middle one; the height is x + 10 y.
{
    printf 'ply\nformat ascii 1.0\ncomment crs EPSG:2056\nelement vertex 16\n'
    printf 'property double x\nproperty double y\nproperty double z\nproperty double depth\n'
    printf 'element face 16\nproperty list uchar int vertex_indices\nend_header\n'
    for y in 0 2 3 5; do for x in 0 2 3 5; do echo "$x $y $((x + 10 * y)) $((-x))"; done; done
    for a in 0 1 2 4 6 8 9 10; do
        echo "3 $a $((a + 1)) $((a + 5))"
        echo "3 $a $((a + 5)) $((a + 4))"
    done
} >m.ply
printf 'x,y\n0.5,0.25\n2.5,2.5\n4,5\n2,2\n-1,1\n5,2.5\n' >q.csv

run prepare m.ply -o m.mwm; exits 0; says_nothing
run prepare m.ply --border -o b.mwm; exits 0; says_nothing
cp b.mwm kept
run prepare m.ply --border -o b.mwm; exits 0
holds "the same mesh gives the same file" cmp -s b.mwm kept
holds "it is that of version 1 in the tests" cmp -s b.mwm \
    "$source_tree/tests/prepared/version_1.mwm"

# Every command answers as from the mesh itself.
for m in m.mwm b.mwm; do
    for c in 'locate -q' 'locate -q --details' 'locate -q --tolerance 1 --walk straight' \
        'locate -q --walk border' 'locate -q --start grid --areas' 'sample -q --outside nearest' \
        'sample -q --field depth'; do
        # shellcheck disable=SC2086 # words
        run $c m.ply q.csv; exits 0
        cp "$logs/out" wanted
        # shellcheck disable=SC2086 # words
        run $c "$m" q.csv; exits 0
        holds "$c $m is that of the mesh" cmp -s "$logs/out" wanted
    done
    run info -q "$m"; exits 0; prints_line '^holes +1$'; prints_line '^crs +EPSG:2056$'
    run check "$m"; exits 0
    run convert -q "$m" back.ply; exits 0
    run convert -q m.ply there.ply; exits 0
    holds "the mesh comes back" cmp -s back.ply there.ply
done
# Rasters, too, where the program was built with GDAL.
for c in '--type float64' '--field depth' '--derive slope,triangle' '--outside nearest' \
    '--max-edge 3.5' '--mean'; do
    # shellcheck disable=SC2086 # words
    run raster -q m.ply --resolution 0.4 $c --driver ENVI -o wanted.img
    grep -Eq 'built with GDAL|cannot be loaded' "$logs/err" && break
    exits 0
    for m in m.mwm b.mwm; do
        # shellcheck disable=SC2086 # words
        run raster "$m" --resolution 0.4 $c --driver ENVI -o out.img; exits 0; says_nothing
        holds "raster $c of $m is that of the mesh" cmp -s out.img wanted.img
        holds "its coordinate system is that of the mesh" cmp -s <(sed '/^desc/,/}/d' out.hdr) \
            <(sed '/^desc/,/}/d' wanted.hdr)
    done
done
cp m.mwm hidden
run locate -q hidden q.csv; exits 0
gzip -kf m.mwm
run sample -q m.mwm.gz q.csv; exits 0; prints_line '^0.5,0.25,3$'
run prepare m.mwm --border -o again.mwm; exits 0
holds "a prepared mesh can be prepared" cmp -s again.mwm b.mwm

# Commands that locate points map the file. --trust leaves its records unchecked, and answers stay.
for c in 'locate -q' 'locate -q --details --tolerance 1' 'locate -q --start layers' \
    'sample -q --field depth' 'sample -q --outside linear'; do
    # shellcheck disable=SC2086 # words
    run $c m.ply q.csv; exits 0
    cp "$logs/out" wanted
    # shellcheck disable=SC2086 # words
    run $c --trust b.mwm q.csv; exits 0
    holds "$c --trust is that of the mesh" cmp -s "$logs/out" wanted
done
run locate -q --trust --tolerance 1 m.mwm q.csv; exits 3
says 'm.mwm: was prepared without --border'
run locate -q --trust m.ply q.csv; exits 3; says 'm.ply: is no prepared mesh'
run locate -q --trust --any m.mwm q.csv; exits 2; says 'not with --any'
sed 's/EPSG:2056/EPSG:2057/' m.mwm >changed.mwm
run locate -q changed.mwm q.csv; exits 3; says 'a damaged prepared mesh'
run locate -q --trust changed.mwm q.csv; exits 0
if command -v strace >/dev/null && strace -o trace true 2>/dev/null; then
    strace -o trace "$meshwalk" locate -q --trust m.mwm q.csv >out
    holds "the file is mapped, not read" \
        grep -q "mmap(NULL, $(stat -c %s m.mwm), PROT_READ, MAP_SHARED" trace
fi

# Fields.
run prepare m.ply --fields depth -o d.mwm; exits 0
run sample -q d.mwm q.csv; exits 3; says "has no field 'z'"
run prepare m.ply --fields none -o n.mwm; exits 0
run sample -q n.mwm q.csv; exits 3; says 'neither heights nor fields'
run prepare m.ply --fields depth,soil -o x.mwm; exits 3; says "m.ply: has no field 'soil'"

# Tiles: a folder that appears when it is complete. The tests of Python read it.
run prepare m.ply --tiles 3 --fields depth -o t.tiles/; exits 0; says_nothing
holds "the files of three tiles" test "$(ls t.tiles | tr '\n' ' ')" = \
    'overview.mwm tile-00000.mwm tile-00001.mwm tile-00002.mwm tiles.json '
holds "the index counts" grep -q '"vertices": 16, "triangles": 16, "holes": \[0\]' t.tiles/tiles.json
run locate -q t.tiles/overview.mwm q.csv; exits 0; prints_line '^2.5,2.5,.*hole'
run info t.tiles/tile-00001.mwm; exits 0; prints_line '^fields +depth,? meshwalk:vertex$'
cp -r t.tiles kept.tiles
run prepare m.ply --tiles 3 -o t.tiles; exits 4; says 't.tiles: exists already; remove it first'
run prepare m.ply --threads 2 --tiles 3 --fields depth -o u.tiles; exits 0
holds "threads make no difference" diff -r t.tiles u.tiles
run prepare m.ply --tiles 17 -o v.tiles; exits 3
says 'm.ply: 17 tiles are more than the 16 triangles with an area'
run prepare m.ply --tiles 3 -o -; exits 2; says 'not standard output'
run prepare m.ply --tiles 3 -o none/v.tiles; exits 4; says 'none/v.tiles: No such file'
sed 's/property double depth/property double meshwalk:vertex/' m.ply >named.ply
run prepare named.ply --tiles 3 -o v.tiles; exits 3; says "the name 'meshwalk:vertex', which tiles need"
last='prepare --tiles, with no room for a file of 3 KiB'
(trap '' XFSZ; ulimit -f 2; exec "$meshwalk" prepare m.ply --tiles 3 -o v.tiles) 2>"$logs/err"
code=$?; exits 4; says 'overview.mwm: File too large'
holds "no folder is left" test -z "$(find . -name 'v.tiles*' -o -name '.tiles-*')"

# Refused: nothing is left behind.
run prepare m.ply; exits 2; says 'needs -o FILE'
run prepare m.ply -o m.ply; exits 2; says 'is both input and output'
printf 'OFF\n4 2 0\n0 0 0\n4 0 0\n2 3 0\n2 2 0\n3 0 1 2\n3 0 1 3\n' >overlap.off
run prepare overlap.off -o x.mwm; exits 3; says "'meshwalk check overlap.off' lists every defect"
run prepare m.ply -o none/x.mwm; exits 4
if [[ -w /dev/full ]]; then
    run prepare m.ply -o /dev/full; exits 4; says 'No space left'
fi
holds "nothing is written" test ! -e x.mwm

# Interrupted: there is the whole output, or nothing.
awk 'BEGIN { srand(2); for (i = 0; i < 20000; i++) print rand(), rand() }' >many.txt
run triangulate -q many.txt -o many.ply; exits 0
for signal in INT TERM HUP; do
    mkdir half
    last="prepare --tiles and SIG$signal"
    # a shell gives its children in the background no SIGINT: perl does
    perl -e '$SIG{INT} = "DEFAULT"; exec @ARGV' \
        "$meshwalk" prepare -q many.ply --tiles 50 -o half/t.tiles 2>"$logs/err" &
    program=$!
    until compgen -G 'half/*tiles*' >/dev/null || compgen -G 'half/.tiles*' >/dev/null; do
        kill -0 $program 2>/dev/null || break
    done
    kill -$signal $program 2>/dev/null
    wait $program 2>/dev/null
    code=$?
    holds "nothing is left, or all is there: $(ls -A half)" test \
        "$(ls -A half)" = "" -o -e half/t.tiles/tiles.json
    rm -r half
done
rm many.ply

# Damaged files.
head -c 1000 m.mwm >short.mwm
run locate short.mwm q.csv; exits 3; says 'short.mwm: a damaged prepared mesh: it has 1000 bytes'
{ head -c 1000 m.mwm; printf 'x'; tail -c +1002 m.mwm; } >changed.mwm
run locate changed.mwm q.csv; exits 3
says "changed.mwm: a damaged prepared mesh: the checksum of part 'points' is wrong"
{ head -c 8 m.mwm; printf '\2'; tail -c +10 m.mwm; } >later.mwm
run info later.mwm; exits 3; says 'format version 2.*prepare it again'
finish
