#!/usr/bin/env bash
# Every command takes a prepared file as a mesh, and says and writes the same bytes as for the mesh
# that it was made of. The commands are those that the program lists: each has a case here.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
"$meshwalk" --version >version
has() { grep -Eq "^ +$1 .*, (built in|found)|^ +$1 +built in" version; }

# --- meshes: with heights, fields and polygons; with marks; with materials; without heights -------

# A hill of nine cells, one of which is a hole, one a quadrilateral.
hill() { # hill PROPERTIES FORMULA: with these values at each vertex
    printf 'ply\nformat ascii 1.0\ncomment crs EPSG:2056\nelement vertex 16\nproperty double x\n'
    printf 'property double y\n%belement face 15\n' "$1"
    printf 'property list uchar int vertex_indices\nend_header\n'
    awk 'BEGIN { for (y = 0; y < 4; y++) for (x = 0; x < 4; x++) {
        printf "%d %d", x == 3 ? 5 : x * 1.5, y == 3 ? 5 : y * 1.5; '"$2"'; print "" } }'
    echo '4 10 11 15 14'
    for a in 0 1 2 4 6 8 9; do
        echo "3 $a $((a + 1)) $((a + 5))"
        echo "3 $a $((a + 5)) $((a + 4))"
    done
}
heights='printf " %d %.2f", 7 * x - x * x + 2 * y, 1 / (x + y + 1)'
hill 'property double z\nproperty float depth\n' "$heights" >hill.ply
hill 'property double z\n' 'printf " %d", 9 + x' >over.ply
hill '' '' >bare.ply
printf '%s\n' 'a mesh' '2 5' '1 0 0 0.5' '2 2 0 1' '3 2 2 -1' '4 0 2 0.001' '5 4 0 7' \
    '1 4 1 2 3 4' '2 3 2 5 3' 1 2 2 1 2 1 2 '2 24' 5 3 >bay.gr3
printf '%s\n' MESH2D 'ND 1 0 0 1' 'ND 2 2 0 2' 'ND 3 2 2 4' 'ND 4 0 2 2' 'E3T 1 1 2 3 7' \
    'E3T 2 1 3 4 9' >soil.2dm

# --- what commands read beside a mesh -------------------------------------------------------------

mkdir beside
cd beside || exit 1
printf 'name,x,y\n' >points.csv
awk 'BEGIN { srand(5); for (i = 0; i < 60; i++) print "p" i "," 7 * rand() - 1 "," 7 * rand() - 1
    print "hole,2.1,2.2\ncorner,1,1\nbad,nan,1" }' >>points.csv
printf 'x,y\n-1,0.5\n2,4.5\n6,1\n' >line.csv
printf 'x,y,z,mx,my,mz\n1,1,50,0,0,-1\n0.3,4,0,1,0,1\n9,9,9,0,0,1\n' >probes.csv
printf 'x,y,z\n1,1,2\n-1,0,0\n' >rays.csv
printf 'locate 0.4 0.3\ninsert 0.75 0.25\nlocate 0.8 0.3\nmove 0 -0.25 0\n' >edits.txt
printf 'probe 0.4 0.3 9 0 0 -1\nmove-vertex 0 -0.25 0 1\n' >surface-edits.txt
ring='[[0.5,0.5],[4,0.5],[4,4.5],[0.5,4.5],[0.5,0.5]]'
cat >area.geojson <<END
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"id": 1},
"geometry": {"type": "Polygon", "coordinates": [$ring]}}]}
END
cat >lines.geojson <<END
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"id": 1},
"geometry": {"type": "LineString", "coordinates": [[0.2, 0.3], [4.4, 4.7]]}}]}
END
cd .. || exit 1

# --- one case -------------------------------------------------------------------------------------

# answer FOLDER ARGUMENTS...: what a command says, writes and ends with, in a folder of its own
# that has the meshes of FOLDER.
answer() {
    local folder=$1
    shift
    rm -rf "answers/$folder"
    mkdir -p "answers/$folder"
    cp beside/* "$folder"/* "answers/$folder/"
    (
        cd "answers/$folder" || exit 1
        timeout 60 "$meshwalk" "$@" >answer.out 2>answer.err
        echo $? >answer.code
        sed -i '/^seconds /d' answer.out # of rasters
    )
    for file in "$folder"/*; do rm "answers/$file"; done # they differ
}

declare -A shown
# same CODE COMMAND ARGUMENTS...: the answers for the mesh and for its prepared files
same() {
    local wanted=$1 folder
    shift
    shown[$1]=1
    last="meshwalk $*"
    answer given "$@"
    code=$(<answers/given/answer.code)
    cp answers/given/answer.err "$logs/err"
    exits "$wanted"
    for folder in "${prepared[@]}"; do
        answer "$folder" "$@"
        holds "of prepared files ($folder): $(diff -r answers/given "answers/$folder" | head -n 8)" \
            diff -rq answers/given "answers/$folder"
    done
}

# meshes LIST...: they stand in `given` as they are, in `mapped` and `border` prepared, under the
# same names, so that messages are the same, too.
meshes() {
    rm -rf given mapped border
    mkdir given mapped border
    for mesh in "$@"; do
        cp "$mesh" given/
        run prepare -q "$mesh" -o made.mwm; exits 0
        mv made.mwm "mapped/$mesh"
        run prepare -q --border "$mesh" -o made.mwm; exits 0
        mv made.mwm "border/$mesh"
    done
    prepared=(mapped border)
}

# --- all commands ---------------------------------------------------------------------------------

# What differs where meshes have marks, polygons, numbers from 1, values of triangles.
in_short() { # in_short MESH
    local mesh=$1
    for as in '' '--json' '--as surface' '--as star'; do
        # shellcheck disable=SC2086 # words
        same 0 info $as "$mesh"
    done
    same 0 check "$mesh"
    same 0 check --json "$mesh"
    same 0 locate --details --base file "$mesh" points.csv
    for to in vtu gr3 msh; do same 0 convert "$mesh" "made.$to"; done
    same 0 edit "$mesh" edits.txt -o made.ply --changes changes.csv --numbers numbers.csv
    same 0 weights --method conservative "$mesh" "$mesh" -o weights.npz
}

# What a mesh without heights answers, too.
in_the_plane() { # in_the_plane MESH
    local mesh=$1
    in_short "$mesh"
    for options in '' '--walk border' '--fill no --walk border' '--areas' '--any' \
        '--tolerance 0.7 --details' '--start layers' '--start curve --walk straight'; do
        # shellcheck disable=SC2086 # words
        same 0 locate $options "$mesh" points.csv
    done
    same 1 locate --strict "$mesh" points.csv
    same 0 weights "$mesh" points.csv -o weights.npz
    same 0 weights --tolerance 0.7 "$mesh" points.csv -o weights.npz
    same 0 weights --method conservative --values vertices "$mesh" "$mesh" -o weights.npz
    same 0 weights --method conservative --norm fracarea --stats "$mesh" "$mesh" -o weights.npz
    for from in 0.1,0.2 '0.3,0.1 --walk straight' '0.2,0.1 --walk border'; do
        # shellcheck disable=SC2086 # words
        same 0 walk --from $from --to 1.9,0.8 "$mesh"
    done
    for to in off ply obj stl vtk 2dm 14 node; do same 0 convert "$mesh" "made.$to"; done
    same 0 prepare "$mesh" -o made.mwm
    same 0 prepare --border --fields none "$mesh" -o made.mwm
    same 0 prepare --tiles 2 "$mesh" -o made.tiles
    same 3 star "$mesh" rays.csv
    same 3 star --onto "$mesh" "$mesh" -o made.ply
}

# What needs heights.
in_space() { # in_space MESH
    local mesh=$1
    for options in '' '--status' '--outside nearest' '--outside linear'; do
        # shellcheck disable=SC2086 # words
        same 0 sample $options "$mesh" points.csv
    done
    same 0 check --as surface "$mesh"
    same 3 check --as star "$mesh"
    same 0 profile "$mesh" line.csv
    same 0 profile --field z --nodata 4 "$mesh" line.csv
    same 0 drape "$mesh" line.csv
    same 0 contours --interval 0.7 "$mesh"
    same 0 contours --interval 0.7 "$mesh" -o made.geojson
    same 0 contours --levels 2,3 "$mesh"
    same 0 volume --base 3 "$mesh"
    same 0 volume --against "$mesh" --json "$mesh"
    same 0 visible --from 0.2,0.2 --height 2 --to points.csv "$mesh"
    same 0 probe "$mesh" probes.csv
    same 0 probe --certain --start random --race 2 "$mesh" probes.csv
    same 0 walk --as surface --from 0.3,0.2,9 --to 1.5,0.8,0 "$mesh"
    same 0 edit --as surface "$mesh" surface-edits.txt -o made.ply
}

with_vectors() { # with_vectors MESH: what GDAL reads and writes
    local mesh=$1
    same 0 drape "$mesh" area.geojson -o made.geojson
    same 0 profile "$mesh" lines.geojson -o made.csv
    same 0 visible --between lines.geojson --height 2 "$mesh"
    same 0 visible --raster --resolution 0.5 --from 1,1 --height 2 "$mesh" -o made.tif
    same 0 raster --resolution 0.5 "$mesh" -o made.tif
    same 0 raster --resolution 0.5 --mean "$mesh" -o made.tif
    same 0 raster --resolution 0.7 --derive slope,aspect,hillshade "$mesh" -o made.tif
}

meshes hill.ply over.ply
in_the_plane hill.ply
in_space hill.ply
same 0 sample --field depth hill.ply points.csv
same 3 sample --field soil hill.ply points.csv
same 0 volume --against over.ply hill.ply
same 0 weights --method conservative hill.ply over.ply -o weights.npz
same 0 edit hill.ply edits.txt -o made.vtu --delaunay make
if has GDAL; then with_vectors hill.ply; else left_out "there is no GDAL"; fi
if has netCDF; then same 0 weights hill.ply points.csv -o weights.nc; fi
if has Cairo; then same 0 walk --from 0.2,0.1 --to 4.9,4.8 hill.ply -o made.png; fi
if has view; then
    same 0 view hill.ply -o made.html
    same 0 view --as surface --points points.csv hill.ply -o made.html
else
    same 2 view hill.ply -o made.html
    left_out "the page was not built"
fi
meshes bay.gr3
prepared=(border)
in_short bay.gr3
same 0 sample --field depth bay.gr3 points.csv
meshes soil.2dm
prepared=(mapped)
in_short soil.2dm
in_space soil.2dm
# Without heights; and of a mesh that has fields, without them.
meshes bare.ply
run prepare -q --fields none hill.ply -o mapped/bare.ply; exits 0
in_short bare.ply
same 3 sample bare.ply points.csv
same 3 contours --interval 1 bare.ply

# What takes no mesh says so.
cp border/bare.ply bare.mwm
same_words() { # same_words CODE WORDS COMMAND ARGUMENTS...
    local wanted=$1 words=$2
    shift 2
    shown[$1]=1
    run "$@"; exits "$wanted"; says "$words"
}
same_words 3 "bare.mwm: this is a mesh \('mwm'\), not a table of points" triangulate bare.mwm \
    -o made.ply
same_words 3 'bare.mwm: ' apply bare.mwm bare.mwm -o made.nc
same_words 2 "unknown table 'bare.mwm'" bench paper bare.mwm

# A folder of tiles is no mesh for commands; its files are, one by one.
run prepare hill.ply --tiles 2 -o hill.tiles; exits 0
printf 'x,y\n1,1\n' >point.csv
refuse_tiles() {
    run "$@"; refused 3 'hill.tiles: holds a mesh in tiles, which meshwalk.Tiles of the Python'
}
for c in info check 'contours --interval 1'; do
    # shellcheck disable=SC2086 # words
    refuse_tiles $c hill.tiles
done
refuse_tiles convert hill.tiles made.ply
refuse_tiles locate hill.tiles point.csv
refuse_tiles sample hill.tiles point.csv
refuse_tiles volume hill.ply --against hill.tiles
refuse_tiles prepare hill.tiles -o made.mwm
run locate --trust hill.tiles point.csv; refused 3 'hill.tiles: is no prepared mesh'
run locate hill.tiles/overview.mwm point.csv; exits 0; prints_line '^1,1,'

# Nor does any command but prepare write such a file.
run convert hill.ply made2.mwm; refused 2 "'meshwalk prepare MESH -o made2.mwm' writes prepared"
run triangulate point.csv -o made2.mwm; refused 2 "'meshwalk prepare MESH -o made2.mwm' writes"
absent made2.mwm

# All that the program lists.
mapfile -t commands < <("$meshwalk" --help | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p')
for c in "${commands[@]}"; do
    holds "$c has no case in $(basename "$0")" test "${shown[$c]:-}"
done
finish
