#!/usr/bin/env bash
# bench scale --ranks: figures that are known beforehand, and that add up.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
run bench scale --ranks 1,10,1e3 --sizes 10000 --queries 20000 --format tsv; exits 0; says_nothing
holds 'the names of the columns' test "$(head -n 1 "$logs/out")" == \
    $'vertices\tranks\tqueries\tlocal\tasked\tmoved\tout_B\tback_B\twork\thot\trounds\tround_B\tboxes_MB'
holds 'nine rows' test "$(tail -n +2 "$logs/out" | cut -f 1-3 | sort -u | wc -l)" == 9
tail -n +2 "$logs/out" >rows
# CHECK NAME CONDITION: no row fails the condition of awk.
check() { holds "$1" test -z "$(awk -F '\t' "!($2)" rows)"; }
check 'one rank asks nobody' '$2 > 1 || ($5 == 0 && $6 == 0 && $7 == 0 && $8 == 0 && $10 == 0)'
check 'one rank locates each point of the mesh once' '$2 > 1 || ($9 > 0.97 && $9 <= 1 && $11 == 1)'
check 'shares are shares' '$4 >= 0 && $4 <= 1 && $6 >= 0 && $6 <= 1'
check 'a question has 16 bytes' '$7 - 16 * $5 < 0.01 && 16 * $5 - $7 < 0.01'
check 'who has the triangle answers, 48 bytes' '$8 <= 48 * $6 + 0.1'
check 'what moved was asked' '$5 >= $6 - 1e-9'
check 'the busiest rank has the mean at least' '$9 >= $4 + $5 - 0.01'
check 'of a uniform set a tenth stays on ten ranks' \
    '$2 != 10 || $3 != "uniform" || ($4 > 0.08 && $4 < 0.12 && $9 < 1.5)'
check 'a hot spot is on one rank of ten, or nearly' '$2 != 10 || $3 != "hot spot" || $9 > 5'
check 'most of a cloud stays where it is on ten ranks' '$2 != 10 || $3 != "cloud" || $4 > 0.6'
check '64 boxes of 40 bytes a rank, and the tree' '$2 != 10 || ($13 > 0.0256 && $13 < 0.03)'
run bench scale --ranks 20 --sizes 1000 --queries 500 uniform; exits 0
prints_line '^ +1000 +20 hot spot( +[0-9.e+-]+){10}$'
run bench scale --ranks 3000 --sizes 1000; refused 2 '3000 ranks are more than the [0-9]+ triangles'
run bench scale --ranks 0; refused 2 "'--ranks' must be numbers from 1 to 1000000"
run bench scale --ranks 4 unifrom; refused 2 "uniform"
run bench scale --ranks 4 --engines geos; refused 2 'takes no times'
run bench peers --ranks 4; refused 2 "is for 'bench scale'"
finish
