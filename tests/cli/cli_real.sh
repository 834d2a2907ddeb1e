#!/usr/bin/env bash
# Real and damaged files, where they are at hand: no crash, and no exit code but 0 and 3.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
data=${MW_SHARED:-}

# The terrain shipped with the project.
terrain=$source_tree/data/jacksboro.csv
run triangulate "$terrain" -o terrain.ply; exits 0; prints_line '^duplicates +0$'
run info terrain.ply; exits 0; prints_line '^delaunay +yes$'; prints_line '^holes +0$'
run sample terrain.ply "$terrain"; exits 0
# At its own points the model has its own heights.
holds "the heights come back" test "$(tail -n +2 "$logs/out" | cut -d, -f1-3 | sort | cksum)" == \
    "$("$meshwalk" sample --walk straight terrain.ply "$terrain" | tail -n +2 | cut -d, -f1-3 | sort | cksum)"
awk -F, -v CONVFMT=%.17g 'FNR == 1 { next } NR == FNR { z[($1 + 0) "," ($2 + 0)] = $3 + 0; next }
    z[($1 + 0) "," ($2 + 0)] != $3 + 0 { print; exit }' "$terrain" "$logs/out" >"$logs/differ"
holds "each height is the one in the file: $(<"$logs/differ")" test ! -s "$logs/differ"

[[ -d $data ]] || { left_out "there is no ../shared/data"; finish; }
printf '0 0\n' >q.xyz
printf '0 0 1\n' >ray.xyz
printf '0 0 9 0 0 -1\n' >probe.xyz
# survives COMMAND...: 0 or 3, or 2 if it asks for columns or a layer; messages as they should be
survives() {
    run "$@"
    checks=$((checks + 1))
    [[ $code == 0 || $code == 3 ]] ||
        grep -q -e 'use --columns' -e '--layer may be one of' "$logs/err" ||
        fail "the exit code should be 0 or 3"
    ! grep -Evq '^meshwalk: ' "$logs/err" || fail "every message should begin with 'meshwalk: '"
    [[ $code == 0 || $1 == check || -s $logs/err ]] || fail "it should say what is wrong"
}
count=0
for file in "$data"/*/*; do
    survives info "$file"
    survives check "$file"
    survives locate --any "$file" q.xyz
    survives triangulate -q "$file" -o mesh.off
    for kind in surface star; do
        survives info --as $kind "$file"
        survives check --as $kind "$file"
    done
    survives star "$file" ray.xyz
    survives probe --any --weld "$file" probe.xyz
    survives probe --any --certain "$file" probe.xyz
    count=$((count + 1))
done
holds "there are files" test "$count" -gt 0
for name in autzen_ground topography_ground crop_4_6_ground; do
    run triangulate "$data/terrain/$name.xyz.gz" -o "$name.ply"; exits 0
    run sample "$name.ply" "$data/terrain/$name.xyz.gz" --strict -o heights.csv; exits 0
done
run triangulate "$data/terrain/1.2-with-color.las" -o las.ply; exits 0; prints_line '^points +1065$'
for class in ground 2 1,2; do
    run triangulate "$data/terrain/1.2-with-color.las" --class $class -o class.ply
    holds "a class is taken or has no points" test $code == 0 -o $code == 3
done
run info "$data/domain/greenland.node.gz"; exits 0; prints_line '^triangles +64125$'
prints_line '^border loops +1$'
run info "$data/ocean/malpasset.ele.gz"; exits 0; prints_line '^triangles +26000$'
finish
