"""Draws the pictures of docs/ARCHITECTURE.md: `python docs/pictures/architecture.py` writes the SVG files beside it.

A row of a picture has one or two boxes: a title, files, and the data that these files may write.
"""

from html import escape
from pathlib import Path

HERE = Path(__file__).parent
WIDTH, MARGIN, GAP, ARROW = 860, 20, 20, 26
TITLE, LINE, PAD = 20, 17, 12

STYLE = """
  .ground { fill: #ffffff; }
  .box { fill: #f4f7fa; stroke: #57606a; stroke-width: 1.2; }
  .disk { fill: #fff6e0; }
  text { font-family: system-ui, sans-serif; font-size: 13px; fill: #1f2328; }
  .title { font-size: 15px; font-weight: 600; }
  .file { font-family: ui-monospace, monospace; font-size: 12px; }
  .writes { font-style: italic; }
  .thread { font-size: 12px; fill: #57606a; }
  .arrow { stroke: #57606a; stroke-width: 1.4; fill: none; }
  .head { fill: #57606a; }
  @media (prefers-color-scheme: dark) {
    .ground { fill: #16191c; }
    .box { fill: #23282c; stroke: #9198a1; }
    .disk { fill: #3a3220; }
    text { fill: #e6edf3; }
    .thread { fill: #9da7b3; }
    .arrow { stroke: #9198a1; }
    .head { fill: #9198a1; }
  }
"""

ROW = [
    [("1. Prepare the study", ["study/prepared.rs, study/plan.rs"],
      ["writes PreparedStudy: baseline, library, one plan per option; read-only afterwards"], "any thread", "")],
    [("2. Draw encounter i", ["encounters/draw.rs, encounters/priors.rs, encounters/density.rs"],
      ["writes Encounter: drawn values and weight, from seed, priors and i only"], "worker thread", "")],
    [("3. Assemble each option", ["study/prepare.rs, encounters/aim.rs, encounters/equilibria.rs"],
      ["writes Prepared: model and start; stores gear at rest in the equilibria, for all threads"], "worker thread", "")],
    [("4. Run", ["study/play.rs, run/mod.rs, app/sim/src/step"],
      ["only app/sim writes State; metrics", "accumulate once in each step"], "worker thread", ""),
     ("or share a run", ["study/equivalence.rs, run/moment.rs"],
      ["copies a row, or starts at the last", "snapshot that two options share"], "worker thread", "")],
    [("5. Make the row", ["study/row.rs, study/runs.rs, figures/"],
      ["writes Row: drawn values and every figure with a column"], "worker thread", "")],
    [("6. Store the block", ["study/batch.rs, study/folder.rs, campaign/leases, table/parquet.rs, table/seal.rs"],
      ["the holder of the lease writes block-00012.parquet once: temporary file, sync, rename"], "worker thread; the disk", "disk")],
    [("7. Merge", ["study/merge.rs"],
      ["writes table.parquet and table.csv from the blocks; the same bytes for any number of processes"], "one thread; the disk", "disk")],
    [("8. Compute the findings", ["study/stats/findings.rs, study/registration.rs"],
      ["writes Findings: rates, paired differences, intervals"], "one thread", "")],
    [("9. Write the report", ["study/report/page.rs, page/svg.rs, assets/report/study.html"],
      ["writes report.html, report.csv, findings.json and bundle"], "one thread; the disk", "disk")],
]

STEP = [
    [("1. Choose the length", ["step/substeps.rs, step/substep_policy.rs, step/stages.rs, step_control.rs"],
      ["writes the policy of this step of the model; reads StepControl of the state"], "SubstepPolicy::next", "")],
    [("2. Find what may touch", ["step/solver_step.rs, contact/mod.rs, broad_phase/, contact/*/kind.rs"],
      ["each kind writes its own pairs; the interface matrix is laid out for coupled bodies"], "Contacts::find", "")],
    [("3. Begin the step", ["solver/step.rs, trial/, forces/water.rs"],
      ["writes Trial: history and predictor x + h v, moved out of contact by each kind"], "Solver::begin_step", "")],
    [("4. Evaluate contact", ["contact/*/measure.rs, contact/law/"],
      ["each kind writes gap, normal force, friction and block of its contact points"], "Contacts::measure", "")],
    [("5. Assemble", ["forces/*.rs, contact/*/kind.rs"],
      ["writes LinearSystem: forces and blocks, always in the same order"], "Solver::assemble", "")],
    [("6. Solve", ["system/mod.rs, system/block_tridiagonal.rs or system/lanes, system/interface.rs, system/coupled.rs"],
      ["writes the moves: rope.step and interface.step"], "LinearSystem::solve", "")],
    [("7. Move, and test the error", ["solver/newton.rs, solver/stopping.rs"],
      ["writes Trial; each kind stores its solved forces. Above the tolerance: back to 4"], "Solver::solve_step", "")],
    [("8. Check the path", ["step/contact.rs, contact/*/path.rs, geometry/sweep.rs, geometry/crossing.rs"],
      ["writes counters of crossings only; a refused path is a Rejection: back to 1, with a shorter step"], "Contacts::check_path", "")],
    [("9. Accept", ["step/solver_step.rs, contact/*/kind.rs, balance/source_forces.rs"],
      ["writes friction of the state, reports of contact, the balance of momentum and energy"], "Contacts::accept", "")],
    [("10. Store", ["solver/step.rs, parting.rs"],
      ["writes State: places, velocities, grips, bodies, time; parts what is overloaded"], "Solver::store", "disk")],
]

CLICK = [
    [("1. A panel draws its button", ["gui/panels/run.rs, gui/panels/study/mod.rs"],
      ["writes its own state; Shared::give appends a command to Shared::commands"], "window thread, while drawing", "")],
    [("2. The window performs the commands", ["gui/app/mod.rs, gui/app/dispatch.rs"],
      ["writes the state of the window: dock, view, questions; passes other commands on"], "window thread, after drawing", "")],
    [("3. The session dispatches the command", ["app/session/src/command/mod.rs, command/run.rs, command/study.rs"],
      ["writes only a notice if the command is not available"], "window thread, or a script", "")],
    [("4. The workbench acts", ["app/session/src/workbench/run.rs, workbench/studies.rs"],
      ["writes Workbench: texts, run, queue of studies; starts threads and returns at once"], "window thread, or a script", "")],
    [("5a. The run", ["live/mod.rs, live/worker/mod.rs, run/mod.rs"],
      ["receives RunCommand, steps the model,", "publishes Arc<LiveView>"], "thread of the run", ""),
     ("5b. The study", ["study/queue.rs, campaign/job.rs"],
      ["runs blocks on worker threads; reports", "progress by Control; writes the disk"], "threads of the job", "disk")],
    [("6. The workbench reads the results", ["workbench/mod.rs (refresh), study/results.rs"],
      ["replaces the shown view and results; results of a study come from its folder, every 4 s"], "window thread, once a frame", "")],
    [("7. Panels draw the view", ["gui/panels/view/mod.rs, app/session/src/scene, app/workbench/src/scene"],
      ["read Arc<LiveView> and write nothing of the simulation"], "window thread, while drawing", "")],
]


def height(box):
    _, files, writes, _, _ = box
    return 2 * PAD + TITLE + LINE * (len(files) + len(writes))


def draw(rows, name, about):
    parts, y = [], MARGIN
    for index, row in enumerate(rows):
        tall = max(height(box) for box in row)
        wide = (WIDTH - 2 * MARGIN - GAP * (len(row) - 1)) / len(row)
        for place, (title, files, writes, thread, kind) in enumerate(row):
            x = MARGIN + place * (wide + GAP)
            parts.append(f'<rect class="box {kind}" x="{x:g}" y="{y}" width="{wide:g}" height="{tall}" rx="6"/>')
            at = y + PAD + 13
            parts.append(f'<text class="title" x="{x + PAD:g}" y="{at}">{escape(title)}</text>')
            parts.append(f'<text class="thread" x="{x + wide - PAD:g}" y="{at}" text-anchor="end">{escape(thread)}</text>')
            at += TITLE
            for kind_of, lines in (("file", files), ("writes", writes)):
                for line in lines:
                    parts.append(f'<text class="{kind_of}" x="{x + PAD:g}" y="{at}">{escape(line)}</text>')
                    at += LINE
        y += tall
        if index + 1 < len(rows):
            columns = max(len(row), len(rows[index + 1]))
            for place in range(columns):
                x = MARGIN + (WIDTH - 2 * MARGIN) * (2 * place + 1) / (2 * columns)
                parts.append(f'<path class="arrow" d="M{x:g} {y}v{ARROW - 8}"/>')
                parts.append(f'<path class="head" d="M{x - 5:g} {y + ARROW - 9}h10l-5 9z"/>')
            y += ARROW
    y += MARGIN
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y}" width="{WIDTH}" height="{y}" role="img">\n'
            f'<title>{escape(about)}</title>\n<style>{STYLE}</style>\n'
            f'<rect class="ground" width="{WIDTH}" height="{y}"/>\n' + "\n".join(parts) + "\n</svg>\n")
    (HERE / f"{name}.svg").write_text(text, encoding="utf-8")


draw(ROW, "life-of-a-study-row", "The life of a study row, from draw to report")
draw(STEP, "life-of-a-solver-step", "The life of a solver step, from its length to the state")
draw(CLICK, "life-of-a-click", "The life of a click, from panel to view")
