//! Runs the golden states on other processors that qemu emulates: x86-64 with and without wide vector registers, and ARM.

use crate::Outcome;
use crate::system_packages::are_here;
use crate::workspace::Workspace;

/// The test for each processor.
const GOLDEN: [&str; 5] = ["test", "--package", "endline-tests", "--test", "golden"];
/// x86-64 processors by qemu's names: SSE2 alone, SSE4.2, AVX2, and AVX2 of another manufacturer.
const KINDS: [&str; 4] = ["qemu64", "Nehalem", "Haswell", "EPYC-Rome"];
/// Target triple of ARM.
const ARM: &str = "aarch64-unknown-linux-gnu";

/// Compares the golden states on each processor that can be emulated with the table of this repository.
/// Errors: when a test cannot be built (`rustup target add aarch64-unknown-linux-gnu` installs the standard
/// library of ARM), or a state differs.
pub fn emulate(workspace: &Workspace) -> Outcome {
    if are_here("other x86-64 processors", &["qemu-x86_64"], "qemu-user") {
        for kind in KINDS {
            let runner = format!("qemu-x86_64 -cpu {kind}");
            let runner = [("CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUNNER", runner.as_str())];
            workspace.cargo_with(&GOLDEN, &runner)?;
        }
    }
    let packages = "qemu-user gcc-aarch64-linux-gnu libc6-dev-arm64-cross";
    if are_here("ARM", &["qemu-aarch64", "aarch64-linux-gnu-gcc"], packages) {
        let arm = [
            (
                "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER",
                "qemu-aarch64 -L /usr/aarch64-linux-gnu",
            ),
            ("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER", "aarch64-linux-gnu-gcc"),
            ("CC_aarch64_unknown_linux_gnu", "aarch64-linux-gnu-gcc"),
        ];
        workspace.cargo_with(&[GOLDEN.as_slice(), &["--target", ARM]].concat(), &arm)?;
    }
    Ok(())
}
