//! The rights that a process of a plugin gives up before it answers: files, sockets, threads, processes and other programs.
//!
//! Two layers. Limits of resources hold on every Unix system. On Linux (x86-64 and ARM64) a filter of system calls, seccomp, acts
//! before them: calls that are not on its list are refused as not permitted, so that a library cannot end, stop or read the program that
//! has started it, even where both run as root.

use rustix::process::{Resource, Rlimit, setrlimit};

/// From here on no file or socket is opened, nothing is written to a file, no thread or process begins, and on Linux no other
/// process is reached.
pub(super) fn enter() {
    for resource in [Resource::Nofile, Resource::Fsize, Resource::Nproc] {
        // A system that refuses leaves the limits of memory and time.
        let _ = setrlimit(resource, Rlimit { current: Some(0), maximum: Some(0) });
    }
    #[cfg(all(target_os = "linux", any(target_arch = "x86_64", target_arch = "aarch64")))]
    if let Some(filter) = filter::program() {
        // A system without filters leaves the limits above.
        let _ = seccompiler::apply_filter_all_threads(&filter);
    }
}

/// System calls that a process may still make.
#[cfg(all(target_os = "linux", any(target_arch = "x86_64", target_arch = "aarch64")))]
mod filter {
    use std::collections::BTreeMap;
    use std::env::consts::ARCH;

    use libc::c_long;
    use seccompiler::{
        BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
        SeccompRule,
    };

    /// Pipes that are open already, memory, time, locks, the start of an existing thread, the process's own signals, its end.
    const ALLOWED: [c_long; 37] = [
        libc::SYS_read,
        libc::SYS_write,
        libc::SYS_readv,
        libc::SYS_writev,
        libc::SYS_close,
        libc::SYS_lseek,
        libc::SYS_fcntl,
        libc::SYS_fstat,
        libc::SYS_ppoll,
        libc::SYS_brk,
        libc::SYS_mmap,
        libc::SYS_munmap,
        libc::SYS_mremap,
        libc::SYS_mprotect,
        libc::SYS_madvise,
        libc::SYS_clock_gettime,
        libc::SYS_clock_getres,
        libc::SYS_clock_nanosleep,
        libc::SYS_nanosleep,
        libc::SYS_gettimeofday,
        libc::SYS_futex,
        libc::SYS_rseq,
        libc::SYS_set_robust_list,
        libc::SYS_sched_yield,
        libc::SYS_sched_getaffinity,
        libc::SYS_membarrier,
        libc::SYS_restart_syscall,
        libc::SYS_getpid,
        libc::SYS_getppid,
        libc::SYS_gettid,
        libc::SYS_getrandom,
        libc::SYS_rt_sigaction,
        libc::SYS_rt_sigprocmask,
        libc::SYS_rt_sigreturn,
        libc::SYS_sigaltstack,
        libc::SYS_exit,
        libc::SYS_exit_group,
    ];

    /// The filter; none for a processor that has no filters here.
    pub(super) fn program() -> Option<BpfProgram> {
        let mut rules: BTreeMap<i64, Vec<SeccompRule>> = ALLOWED
            .into_iter()
            .chain(only_on_x86_64().iter().copied())
            .map(|call| (call, Vec::new()))
            .collect();
        rules.insert(libc::SYS_tgkill, vec![to_itself()?]);
        let refused = SeccompAction::Errno(libc::EPERM.unsigned_abs());
        let filter =
            SeccompFilter::new(rules, refused, SeccompAction::Allow, ARCH.try_into().ok()?);
        filter.ok()?.try_into().ok()
    }

    /// A signal to this process alone, which `abort` is.
    fn to_itself() -> Option<SeccompRule> {
        let own = u64::from(std::process::id());
        let own = SeccompCondition::new(0, SeccompCmpArgLen::Dword, SeccompCmpOp::Eq, own);
        SeccompRule::new(vec![own.ok()?]).ok()
    }

    /// Calls that later processors have under another name only.
    const fn only_on_x86_64() -> &'static [c_long] {
        #[cfg(target_arch = "x86_64")]
        return &[libc::SYS_poll, libc::SYS_time];
        #[cfg(not(target_arch = "x86_64"))]
        &[]
    }
}
