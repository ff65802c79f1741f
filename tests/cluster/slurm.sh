#!/bin/sh
# A study on a real Slurm of one node, begun here and ended here: an array of 8 tasks, one of them killed, one put back into the
# queue, and the table compared with that of a single process, byte by byte.
#
# usage: [LASTS=120] slurm.sh PROGRAM FOLDER    as root, with slurmctld, slurmd and munged installed; FOLDER is made anew, and LASTS
#                                               is how long each encounter lasts [s]
set -eu

if [ "$(id -u)" != 0 ]; then
    echo "slurm.sh: skipped: only root can begin a Slurm" >&2
    exit 0
fi
program=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
place=$(realpath "$2")
here=$(dirname "$(realpath "$0")")
library=$here/../../gear-library
machine=$(hostname -s)

fail() {
    echo "slurm.sh: $1" >&2
    exit 1
}

# One node with more places than cores, so that all tasks run at once.
begin_cluster() {
    mkdir -p "$place/cluster/state" "$place/cluster/spool"
    chmod 700 "$place/cluster"
    head -c 1024 /dev/urandom > "$place/cluster/key"
    chmod 400 "$place/cluster/key"
    munged --force --key-file="$place/cluster/key" --socket="$place/cluster/munge" --pid-file="$place/cluster/munged.pid" \
        --log-file="$place/cluster/munged.log" --seed-file="$place/cluster/seed"
    sed -e "s|PLACE|$place/cluster|g" -e "s|MACHINE|$machine|g" "$here/slurm.conf" > "$place/cluster/slurm.conf"
    export SLURM_CONF="$place/cluster/slurm.conf"
    slurmctld
    slurmd
    tries=0
    until sinfo --noheader --format=%t 2> /dev/null | grep -q idle; do
        tries=$((tries + 1))
        [ $tries -lt 60 ] || fail "the node never came up: see $place/cluster"
        sleep 0.5
    done
}

end_cluster() {
    for daemon in slurmd slurmctld munged; do
        file="$place/cluster/$daemon.pid"
        [ ! -f "$file" ] || kill "$(cat "$file")" 2> /dev/null || true
    done
}

seconds() { date +%s.%N; }

study() { "$program" study "$@" --library "$library"; }

# Waits until nothing is queued any more.
wait_for_jobs() {
    while [ -n "$(squeue --noheader)" ]; do sleep 0.2; done
}

done_of() { find "$1" -maxdepth 1 -name 'block-*.parquet' 2> /dev/null | wc -l; }

# The library with the study of this test, and its gear without a whale.
make_study() {
    cp -r "$library" "$place/library"
    library=$place/library
    cp "$here/study.toml" "$library/studies/slurm-study.toml"
    sed -e '/^\[whale\]/,$d' -e '/^\[resolution\]/,/^edges/d' \
        -e 's/^duration = .*/duration = "'"${LASTS:-30}"' s"/' -e 's/^rope_nodes = .*/rope_nodes = 60/' \
        "$library/scenarios/study-endline-held.toml" > "$library/studies/slurm-scenario.toml"
}

trap end_cluster EXIT
make_study
begin_cluster

began=$(seconds)
study run slurm-study --out "$place/alone" --threads "$(nproc)" --eager
alone=$(echo "$(seconds) - $began" | bc)
study merge slurm-study --out "$place/alone"

began=$(seconds)
study submit slurm-study --out "$place/array" --slurm --array 8 --memory 100M --time 10:00
while [ "$(done_of "$place/array")" -lt 20 ]; do sleep 0.05; done
study status slurm-study --out "$place/array"
jobs=$(squeue --noheader --array --states=RUNNING --format=%A)
killed=$(echo "$jobs" | sed -n 2p)
again=$(echo "$jobs" | sed -n 3p)
scancel --signal=KILL --full "$killed"
scontrol requeue "$again"
echo "killed $killed, put $again back, at $(done_of "$place/array") encounters"
until [ "$(done_of "$place/array")" = "$(done_of "$place/alone")" ]; do sleep 0.05; done
array=$(echo "$(seconds) - $began" | bc)
wait_for_jobs
squeue --states=all --format='%i %T %r'
cmp "$place/alone/table.parquet" "$place/array/table.parquet" || fail "the tables differ"
[ -f "$place/array/report.html" ] || fail "no report"
echo "same bytes; alone $alone s, by 8 tasks of which one was killed and one put back $array s"

# Undisturbed, with a task for each core, to tell what the queue costs.
began=$(seconds)
study submit slurm-study --out "$place/whole" --slurm --array "$(nproc)" --time 10:00
until [ "$(done_of "$place/whole")" = "$(done_of "$place/alone")" ]; do sleep 0.05; done
echo "by $(nproc) tasks $(echo "$(seconds) - $began" | bc) s"
wait_for_jobs
cmp "$place/alone/table.parquet" "$place/whole/table.parquet" || fail "the tables differ"
