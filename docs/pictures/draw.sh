#!/bin/sh
# Draws the pictures of docs/gear-types.md: settles each template and renders it, without a display.
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
"$endline" render $scenarios/on-demand-release.toml --at 23 --out $pictures/gear-on-demand-rising.png --size 960x600
"$endline" render $scenarios/gillnet.toml --out $pictures/gear-gillnet.png --size 1280x640
"$endline" render $scenarios/gillnet.toml --out $pictures/gear-gillnet-end.png --size 960x480 --fit bridle-top,headline-1,headline-2,leadline-2
"$endline" render $scenarios/time-tension-cutter.toml --at 25 --out $pictures/gear-cutter.png --size 960x600
