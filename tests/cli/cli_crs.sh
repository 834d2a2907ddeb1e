#!/usr/bin/env bash
# Coordinate systems: where meshes and points tell theirs, and what keeps it.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"

# A comment of PLY, and .prj files beside: kept by what writes meshes.
printf '%s\n' "$square" >square.off
run info square.off; exits 0; prints_line '^crs +not known$'
run info --json square.off; exits 0; prints_line '"crs": null'
echo 'EPSG:2056' >square.prj
run info --json square.off; exits 0; prints_line '"crs": "EPSG:2056"'
echo 'move 0 0.1 0.1' >edits.txt
run edit -q square.off edits.txt -o edited.ply; exits 0
run info --as surface edited.ply; exits 0; prints_line '^crs +EPSG:2056$'
printf 'x,y,z\n0,0,1\n1,0,2\n0,1,3\n' >points.csv
run triangulate -q points.csv -o points.ply; exits 0
run info points.ply; prints_line '^crs +not known$'
echo 'PROJCS["some grid", UNIT["metre", 1]]' >points.prj
run triangulate -q points.csv -o points.ply; exits 0
run info points.ply; prints_line '^crs +PROJCS\["some grid", UNIT\["metre", 1\]\]$'
finish
