# tools/arrows.awk - compares the includes of a tree with the table of its rooms, for check_arrows.
#
# Lines of the input, the table first, then the files, then their includes:
#   T NUMBER TEXT     a line of the table
#   F PATH            a source file
#   I PATH:NUMBER:TEXT  a line of a file that has an #include
# A unit is a file without its ending: x.c and x.h are one. An arrow leads from a unit, or room, to
# one that it includes.

function fail(text)
{
    print text
    wrong = 1
}

function folder(path)
{
    return path ~ /\// ? substr(path, 1, match(path, /\/[^\/]*$/) - 1) : "."
}

function unit(path)
{
    sub(/\.[a-z]+$/, "", path)
    return path
}

# --- the table

function read_words(text, words)
{
    sub(/^[ \t]+/, "", text)
    return split(text, words, /[ \t]+/)
}

function read_row(number, name, words, n,    i)
{
    if (name in row) fail(table ":" number ": " name " has a row already, in line " row[name])
    row[name] = number
    rows[++row_count] = name
    for (i = 1; i <= n; i++) use[name, i] = words[i]
    uses[name] = n
}

function read_table(number, text,    name, n, i, words)
{
    sub(/[ \t]*(#.*)?$/, "", text)
    if (text == "") return
    if (text !~ /^[^ \t:]+:/) {
        fail(table ":" number ": not of the form 'room: rooms it may use'")
        return
    }
    name = substr(text, 1, index(text, ":") - 1)
    n = read_words(substr(text, index(text, ":") + 1), words)
    if (name == "crowded") {
        for (i = 1; i <= n; i++) crowded[words[i]] = number
    } else if (name == "circle") {
        for (i = 1; i <= n; i++) tolerated[number, words[i]] = 1
        tolerance[number] = 0
    } else {
        read_row(number, name, words, n)
    }
}

# --- which room may include what

function matches(name, pattern)
{
    if (pattern !~ /\*/) return name == pattern
    return index(name, substr(pattern, 1, index(pattern, "*") - 1)) == 1
}

# `name`: a room, or a public header as <x.h>. Notes which entry of the table permits it.
function permits(room, name,    i, found)
{
    for (i = 1; i <= uses[room]; i++)
        if (matches(name, use[room, i])) used[room, i] = found = 1
    return found
}

# --- the includes

# A path without "folder/.." in it.
function plain(path)
{
    while (sub(/[^\/]+\/\.\.\//, "", path)) ;
    return path
}

# The file that `name` in "" means, seen from a folder: there, in a folder round it, or under one of
# the roots.
function resolve(from, name,    i)
{
    for (; from != "."; from = folder(from))
        if (plain(from "/" name) in file) return plain(from "/" name)
    if (name in file) return name
    for (i = 1; i <= root_count; i++)
        if (roots[i] "/" name in file) return roots[i] "/" name
    return ""
}

function add_arrow(graph, from, to, place)
{
    if (from == to || (graph, from, to) in arrow) return
    arrow[graph, from, to] = place
    if (!((graph, from) in degree)) nodes[graph, ++node_count[graph]] = from
    heads[graph, from, ++degree[graph, from]] = to
}

function read_include(text,    path, number, place, room, name, target)
{
    path = substr(text, 1, index(text, ":") - 1)
    text = substr(text, length(path) + 2)
    number = substr(text, 1, index(text, ":") - 1)
    place = path ":" number
    room = folder(path)
    if (match(text, /<meshwalk\/[^>]+>/)) {
        name = substr(text, RSTART + 10, RLENGTH - 11)
        add_arrow("file", unit(path), unit("include/meshwalk/" name), place)
        if (!permits(room, "<" name ">"))
            fail(place ": " room " may not include <meshwalk/" name ">; see " table)
    } else if (match(text, /"[^"]+"/)) {
        name = substr(text, RSTART + 1, RLENGTH - 2)
        target = resolve(room, name)
        if (target == "") {
            fail(place ": there is no \"" name "\"")
            return
        }
        add_arrow("file", unit(path), unit(target), place)
        if (folder(target) != room && !permits(room, folder(target)))
            fail(place ": " room " may not include \"" name "\" of " folder(target) "; see " table)
    }
}

# --- circles

function is_tolerated(first, last,    number, i)
{
    for (number in tolerance) {
        for (i = first; i <= last && (number, way[i]) in tolerated; i++) ;
        if (i > last) return tolerance[number] = 1
    }
    return 0
}

# The circle way[first], ..., way[last], from the lowest name on: each arrow with its place.
function show_circle(graph, first, last,    n, low, i, from, to, place, text, places)
{
    if (graph == "file" && is_tolerated(first, last)) return
    n = last - first + 1
    for (i = low = first; i <= last; i++)
        if (way[i] < way[low]) low = i
    text = way[low]
    for (i = low; i < low + n; i++) {
        from = way[first + (i - first) % n]
        to = way[first + (i + 1 - first) % n]
        text = text " -> " to
        if (i > low) places = places "\n  " arrow[graph, from, to]
        else place = arrow[graph, from, to]
    }
    fail(place ": circle of " graph "s: " text places)
}

function visit(graph, node, depth,    i, k, next_node)
{
    state[graph, node] = 1
    way[depth] = node
    for (i = 1; i <= degree[graph, node]; i++) {
        next_node = heads[graph, node, i]
        if (state[graph, next_node] == 1) {
            for (k = depth; way[k] != next_node; k--) ;
            show_circle(graph, k, depth)
        } else if (!state[graph, next_node]) {
            visit(graph, next_node, depth + 1)
        }
    }
    state[graph, node] = 2
}

function find_circles(graph,    i)
{
    for (i = 1; i <= node_count[graph]; i++)
        if (!state[graph, nodes[graph, i]]) visit(graph, nodes[graph, i], 1)
}

function check_circles(    number)
{
    find_circles("room")
    find_circles("file")
    for (number in tolerance)
        if (!tolerance[number]) fail(table ":" number ": these files make no circle")
}

# --- the table as a whole

# Each entry names a room that there is, and which something includes.
function check_entry(room, i,    k, entry, known)
{
    entry = use[room, i]
    for (k = 1; k <= row_count; k++)
        if (matches(rows[k], entry)) {
            known = 1
            add_arrow("room", room, rows[k], table ":" row[room])
        }
    if (!known && entry !~ /^</)
        fail(table ":" row[room] ": " entry " of " room " is no room")
    else if (!((room, i) in used))
        fail(table ":" row[room] ": " room " includes nothing of " entry)
}

function check_table(    k, i, room)
{
    for (k = 1; k <= row_count; k++) {
        room = rows[k]
        if (!(room in first_file)) fail(table ":" row[room] ": no source file is in " room)
        for (i = 1; i <= uses[room]; i++) check_entry(room, i)
    }
}

function check_folders(    k, room)
{
    for (k = 1; k <= folder_count; k++) {
        room = folders[k]
        if (!(room in row)) fail(first_file[room] ": " table " has no row for " room)
        if (size[room] > MOST && !(room in crowded))
            fail(room ": " size[room] " source files; a folder has at most " MOST)
    }
    for (room in crowded)
        if (size[room] <= MOST) fail(table ":" crowded[room] ": " room " is not crowded")
}

# --- all of it

BEGIN {
    MOST = 30
    root_count = split("src cli bench tests", roots, " ")
}

$1 == "T" {
    number = $2
    sub(/^T [0-9]+ ?/, "")
    read_table(number, $0)
}

$1 == "F" {
    file[$2] = 1
    if ($2 ~ /\.def$/) next
    room = folder($2)
    if (!(room in first_file)) {
        first_file[room] = $2
        folders[++folder_count] = room
    }
    size[room]++
}

$1 == "I" {
    sub(/^I /, "")
    read_include($0)
}

END {
    check_folders()
    check_table()
    check_circles()
    exit wrong
}
