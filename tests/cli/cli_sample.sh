#!/usr/bin/env bash
# sample: heights and fields, and what points outside get.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >square.off
points=$'0.75 0.25\n1 1\n2 0.5\n-1 -1\nnan 0\n'

run_on "$points" sample square.off -; exits 0; says_nothing
prints $'x,y,z\n0.75,0.25,1\n1,1,2\n2,0.5,\n-1,-1,\nnan,0,'
# The mesh lies in the plane z = x + y.
run_on "$points" sample --outside nearest square.off -; exits 0
prints $'x,y,z\n0.75,0.25,1\n1,1,2\n2,0.5,1.5\n-1,-1,0\nnan,0,'
run_on "$points" sample --outside linear square.off -; exits 0
prints $'x,y,z\n0.75,0.25,1\n1,1,2\n2,0.5,2.5\n-1,-1,-2\nnan,0,'
run_on "$points" sample --outside empty --tolerance 1 square.off -; exits 0
prints $'x,y,z\n0.75,0.25,1\n1,1,2\n2,0.5,1.5\n-1,-1,\nnan,0,'
run_on "$points" sample --strict square.off -; exits 1
run_on $'3 3\n' sample --strict --outside nearest square.off -; exits 0; prints $'x,y,z\n3,3,2'
for start in grid two-level-grid layers; do
    run_on "$points" sample --start $start --cells 9 --layers 2 --finish stochastic square.off -
    exits 0
    prints $'x,y,z\n0.75,0.25,1\n1,1,2\n2,0.5,\n-1,-1,\nnan,0,'
done
for threads in 1 2; do
    run_on "$points" sample --threads $threads --walk straight --start random square.off -; exits 0
    prints $'x,y,z\n0.75,0.25,1\n1,1,2\n2,0.5,\n-1,-1,\nnan,0,'
done

# Missing values: of a square of four triangles about its middle, vertex 1 has none.
missing_mesh() { # missing_mesh VALUE: z at vertex 1
    printf '%s\n' 'OFF' '5 4 0' '0 0 1' "2 0 $1" '2 2 3' '0 2 4' '1 1 5' '3 0 1 4' '3 1 2 4' \
        '3 2 3 4' '3 3 0 4'
}
lost=$'x,y\n1,0.5\n1.75,1\n0.5,0.5\n2,0\n1,1.5\n3,0.25\n'
for value in nan -99999; do
    missing_mesh $value >lost.off
    run_on "$lost" sample --status lost.off -; exits 0
    run_on "$lost" sample -q --strict lost.off -; exits 1
    run_on "$lost" sample --status lost.off -
    prints $'x,y,z,status\n1,0.5,,missing\n1.75,1,,missing\n0.5,0.5,3,edge\n2,0,,missing\n1,1.5,4.25,inside\n3,0.25,,outside'
    [[ $value == nan ]] && says_nothing
    [[ $value == nan ]] || says \
        'lost\.off: remark: z is -99999 at 1 vertex; --nodata none would treat it as a value'
    run_on "$lost" sample -q --strict --status --missing nearest --outside nearest lost.off -
    exits 0; says_nothing
    prints $'x,y,z,status\n1,0.5,5,missing\n1.75,1,5,missing\n0.5,0.5,3,edge\n2,0,5,missing\n1,1.5,4.25,inside\n3,0.25,3,missing'
done
run_on "$lost" sample --nodata none lost.off -; exits 0; says_nothing; prints_line '^2,0,-99999$'
prints_line '^1,0.5,-24997$'
missing_mesh -9999 >lost.off
run_on "$lost" sample lost.off -; exits 0; prints_line '^2,0,-9999$'
says 'lost\.off: remark: z is -9999 at 1 vertex; --nodata -9999 would treat it as missing'
run_on "$lost" sample --nodata -9999 lost.off -; exits 0; says_nothing; prints_line '^2,0,$'
prints_line '^0.5,0.5,3$'
missing_mesh 0.10000000149011612 >lost.off
run_on "$lost" sample --nodata 0.1 lost.off -; exits 0; prints_line '^2,0,$'
for wrong in x 1x ''; do
    run sample --nodata "$wrong" absent.off p.xyz
    refused 2 "'--nodata' must be"
done

# Fields: attributes of a .node file, named in the header.
printf '4 2 2 0\n0 0 0 10 5\n1 1 0 20 5\n2 1 1 30 5\n3 0 1 20 5\n' >flow.node
printf '2 3 0\n0 0 1 2\n1 0 2 3\n' >flow.ele
run info --json flow.node; exits 0
mapfile -t fields < <(perl -MJSON::PP -e 'local $/; print "$_\n" for @{decode_json(<STDIN>)->{fields}}' <"$logs/out")
holds "the mesh has heights or fields" test "${#fields[@]}" -ge 1
for field in "${fields[@]}"; do
    run_on $'0.5 0.5\n' sample --field "$field" flow.ele -; exits 0
    prints_line "^x,y,$field\$"; prints_line '^0.5,0.5,(20|5)$'
done
run_on $'0.5 0.5\n' sample --field salt flow.node -
refused 3 "flow\.node: has no field 'salt'; --field may be one of:"

# A mesh with nothing to sample.
printf '3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n' >bare.node
printf '1 3 0\n1 1 2 3\n' >bare.ele
run_on $'0.1 0.1\n' sample bare.node - -o out.csv
refused 3 'bare\.node: has neither heights nor fields'; absent out.csv
run_on $'0.1 0.1\n' locate bare -; exits 0; prints_line '^0.1,0.1,inside,0,'

# Values of triangles: that of the triangle with the point; continuous on request.
cat >cells.vtk <<'END'
# vtk DataFile Version 3.0
two triangles and a quadrilateral
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 6 double
0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0
CELLS 3 13
3 0 1 2
3 0 2 3
4 1 4 5 2
CELL_TYPES 3
5 5 9
CELL_DATA 3
SCALARS rough double 1
LOOKUP_TABLE default
2 4 -99999
END
cells=$'0.75 0.25\n0.25 0.75\n0.5 0.5\n1.5 0.5\n-1 2\n0 0\n'
inside=$'x,y,rough,status\n0.75,0.25,2,inside\n0.25,0.75,4,inside\n0.5,0.5,2,edge\n1.5,0.5,,missing'
run_on "$cells" sample --field rough --status cells.vtk -; exits 0
prints "$inside"$'\n-1,2,,outside\n0,0,2,vertex'
says '^meshwalk: cells.vtk: remark: rough is -99999 at 2 triangles; --nodata none'
for outside in nearest linear; do
    run_on "$cells" sample --field rough --status -q --outside $outside --missing nearest \
        cells.vtk -
    exits 0; says_nothing; prints "$inside"$'\n-1,2,4,outside\n0,0,2,vertex'
done
run_on "$cells" sample --field rough --recover -q cells.vtk -; exits 0
prints $'x,y,rough\n0.75,0.25,2.5\n0.25,0.75,3.5\n0.5,0.5,3\n1.5,0.5,\n-1,2,\n0,0,3'
sed 's/ -99999/ 8/' cells.vtk >whole.vtk
run_on "$cells" sample --field rough whole.vtk -; exits 0; says_nothing
cp "$logs/out" whole.csv
for name in whole.vtu whole.nc; do
    "$meshwalk" --version | grep -q 'libnetcdf is not found' && [[ $name == whole.nc ]] && continue
    run convert -q whole.vtk $name; exits 0
    run_on "$cells" sample --field rough $name -; exits 0; prints "$(<whole.csv)"
done
printf '%s\n' MESH2D 'E3T 1 1 2 3 7' 'E3T 2 1 3 4 9' 'ND 1 0 0 5' 'ND 2 1 0 5' 'ND 3 1 1 5' \
    'ND 4 0 1 5' >cells.2dm
run_on "$cells" sample --field material --only-answers cells.2dm -; exits 0
prints $'x,y,material\n0.75,0.25,7\n0.25,0.75,9\n0.5,0.5,7\n1.5,0.5,\n-1,2,\n0,0,7'
run sample --field smooth cells.2dm -; refused 3 'has no field .smooth.; --field may be one of: z material'
run contours --field material --interval 1 cells.2dm
refused 3 "'material' is a field of triangles; values at vertices are needed"
run sample --wide cells.vtk -; refused 2 "'--wide' needs --time"
finish
