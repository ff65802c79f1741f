#!/bin/sh
# The program as it is built for Windows, run under Wine and held against the same code on this system: a run, a recording made here,
# a study and a loaded plugin. State hashes and tables must be the same to the bit.
#
# usage: wine.sh PROGRAM FOLDER    PROGRAM is this system's; that for Windows and its plugin library lie in
#                                  ../x86_64-pc-windows-gnu beside its folder, where `cargo xtask windows` builds them.
#                                  FOLDER is made anew.
set -eu

rm -rf "$2"
mkdir -p "$2/here" "$2/plugins"
place=$(realpath "$2")
root=$(realpath "$(dirname "$0")/../..")
products=$(dirname "$(realpath "$1")")
windows=$(dirname "$products")/x86_64-pc-windows-gnu/$(basename "$products")
# Alone in its folder, the program here runs on the plugins that are linked into it, as the other does.
cp "$1" "$place/here/endline"
export WINEPREFIX="$place/wine" WINEDEBUG=-all
export XDG_DATA_HOME="$place/data" XDG_CACHE_HOME="$place/cache"

fail() {
    echo "wine.sh: $1" >&2
    exit 1
}

# A file or folder as Windows sees it.
seen() { echo "Z:$1" | tr / '\\'; }

here() { "$place/here/endline" --quiet --library "$root/gear-library" "$@"; }
there() { timeout 600 wine "$windows/endline.exe" --quiet --library "$(seen "$root/gear-library")" "$@"; }

hash_of() { grep -o '"state_hash":"[0-9a-f]*"' "$1"; }

same_run() {
    here run hello-endline --json --out "$place/run" > "$place/here.json"
    there run hello-endline --json > "$place/there.json"
    [ "$(hash_of "$place/here.json")" = "$(hash_of "$place/there.json")" ] || fail "hello-endline ends in another state"
    echo "hello-endline: the same state, $(hash_of "$place/here.json")"
}

same_replay() {
    there replay "$(seen "$place/run/recording.endline")" --verify > "$place/replay.txt" ||
        fail "the recording made here does not give its bits there: $(cat "$place/replay.txt")"
    tail -n 1 "$place/replay.txt"
}

same_study() {
    study=$root/tests/windows/study.toml
    here study run "$study" --out "$place/study-here" --eager
    here study merge "$study" --out "$place/study-here"
    there study run "$(seen "$study")" --out "$(seen "$place/study-there")" --eager
    there study merge "$(seen "$study")" --out "$(seen "$place/study-there")"
    cmp "$place/study-here/table.parquet" "$place/study-there/table.parquet" || fail "the tables of the study differ"
    echo "study of 8 encounters: the same table"
}

plugin_loads() {
    library=$place/plugins/endline_friction_models.dll
    cp "$windows/endline_friction_models.dll" "$library"
    there plugins check "$(seen "$library")" > "$place/plugin.txt" || fail "the plugin does not pass: $(cat "$place/plugin.txt")"
    ENDLINE_PLUGINS=$(seen "$place/plugins") there --allow-plugins run hello-endline --json > "$place/plugin.json"
    grep -q '"file_hash":"[0-9a-f]\{64\}"' "$place/plugin.json" || fail "the run did not use the plugin's file"
    [ "$(hash_of "$place/here.json")" = "$(hash_of "$place/plugin.json")" ] || fail "the plugin's file gives another state"
    echo "plugin of a library: sound, and the same state"
}

[ -f "$windows/endline.exe" ] || fail "there is no $windows/endline.exe: cargo xtask windows builds it"
x86_64-w64-mingw32-gcc -shared -O -o "$windows/bcryptprimitives.dll" "$root/tests/windows/bcryptprimitives.c" -ladvapi32
there --version
same_run
same_replay
same_study
plugin_loads
