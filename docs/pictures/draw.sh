#!/bin/sh
# Draws the pictures of docs/gear-types.md and docs/entanglement.md, and the hitches of docs/lab-notebook.md: settles each template, lays each wrap and renders it, without
# a display.
# Run from the workspace root after `cargo build`, with the program as first argument where it is not on the PATH.
set -eu
endline=${1:-endline}
pictures=docs/pictures
scenarios=gear-library/scenarios
scratch=
trap 'rm -f $scratch' EXIT

# assembly, depth, current, segment, heading, picture and options of `render`
at_rest() {
    scratch=$scenarios/$1-at-rest.toml
    cat >"$scratch" <<END
format = 1
kind = "scenario"
name = "$1"
duration = "1 s"
segment = "$4"
[site]
item = "cape-cod-bay"
depth = "$2"
[current]
speed = "$3"
toward = "90 deg"
[[gear]]
assembly = "$1"
heading = "$5"
END
    picture=$6
    shift 6
    "$endline" render "$scratch" --out "$pictures/$picture.png" "$@"
    rm "$scratch"
}

at_rest single "25 m" "0.15 m/s" "0.5 m" "90 deg" gear-single --view orbit --size 960x600
at_rest pair "40 m" "0.15 m/s" "0.5 m" "90 deg" gear-pair --view orbit --size 960x600
at_rest trawl-10 "60 m" "0.15 m/s" "1 m" "120 deg" gear-trawl --view orbit --size 1280x640 --fit trap-1,trap-5,buoy,high-flyer
at_rest trawl-5 "25 m" "0.15 m/s" "0.25 m" "120 deg" gear-trawl-traps --view orbit --size 960x480 --fit trap-1,trap-2,gangion-1,gangion-2
at_rest on-demand-single "25 m" "0.1 m/s" "0.25 m" "90 deg" gear-on-demand --view orbit --size 960x600
"$endline" render $scenarios/on-demand-release.toml --at 23s --out $pictures/gear-on-demand-rising.png --size 960x600
"$endline" render $scenarios/gillnet.toml --out $pictures/gear-gillnet.png --size 1280x640
"$endline" render $scenarios/gillnet.toml --out $pictures/gear-gillnet-end.png --size 960x480 --fit bridle-top,headline-1,headline-2,leadline-2
"$endline" render $scenarios/time-tension-cutter.toml --at 25s --out $pictures/gear-cutter.png --size 960x600

"$endline" render $scenarios/twisted-bight.toml --at 16s --view orbit --fit endline --size 960x480 --out $pictures/twisted-bight.png
"$endline" render $scenarios/hitches.toml --at 3s --view front --fit "half hitches" --size 640x400 --out $pictures/hitches.png

# part, turns, ends of the rope, pitch, length, view, picture and azimuth: rope wound about a right whale that heads east
wrapped() {
    scratch=$scenarios/wrapped.toml
    cat >"$scratch" <<END
format = 1
kind = "scenario"
name = "$2 turns"
duration = "1 s"
segment = "0.2 m"
start = "placed"
[site]
item = "cape-cod-bay"
[current]
speed = "0 m/s"
toward = "90 deg"
[whale]
item = "right-whale"
length = "13 m"
position = ["0 m", "0 m"]
depth = "8 m"
heading = "90 deg"
speed = "0 m/s"
motion = "org.endline.motion.swim"
[friction]
model = "org.endline.friction.coulomb"
[[joint]]
id = "one end"
position = [$3]
[[joint]]
id = "other end"
position = [$4]
[[line]]
id = "rope"
rope = "pp-3-4"
from = "one end"
to = "other end"
length = "$6"
start = "wrapped"
[[line.wrap]]
part = "$1"
turns = $2
pitch = "$5"
azimuth = "$9"
pretension = "2 kN"
END
    "$endline" render "$scratch" --at 0.01s --view "$7" --fit rope --size 480x320 --out "$pictures/$8.png"
    rm "$scratch"
}

above='"-4.3 m", "1.6 m", "-7.5 m"'
wrapped peduncle -0.5 "$above" '"-4.5 m", "1.6 m", "-8.3 m"' "10 cm" "6 m" side wrap-peduncle-half "0 deg"
wrapped peduncle -1 "$above" '"-4.6 m", "-1.6 m", "-7.5 m"' "20 cm" "8 m" side wrap-peduncle-one "0 deg"
wrapped peduncle -2.25 "$above" '"-4.8 m", "-0.4 m", "-9.4 m"' "20 cm" "11 m" side wrap-peduncle-two-and-a-quarter "0 deg"
