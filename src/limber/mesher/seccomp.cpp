// SPDX-License-Identifier: BSD-3-Clause
#include "limber/mesher/seccomp.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "limber/fem/mesh/mesher.hpp"
#include "limber/mesher/refusal.hpp"

#ifndef CLONE_THREAD
#define CLONE_THREAD 0x00010000
#endif

namespace limber::mesher {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;  // no filter
#endif

/// What a refused call would have done, for the message.
enum class Action { program, process, writing, network };

struct Refusal {
  std::uint32_t call;
  Action deed;
};

// Calls that end the mesher with a message. Any call neither here nor among the
// needed ones fails with ENOSYS.
constexpr Refusal kRefusals[] = {
    {SYS_execve, Action::program},    {SYS_execveat, Action::program},
    {SYS_socket, Action::network},    {SYS_socketpair, Action::network},
    {SYS_mkdirat, Action::writing},   {SYS_mknodat, Action::writing},
    {SYS_unlinkat, Action::writing},  {SYS_linkat, Action::writing},
    {SYS_symlinkat, Action::writing}, {SYS_fchmodat, Action::writing},
    {SYS_fchownat, Action::writing},  {SYS_truncate, Action::writing},
    {SYS_ftruncate, Action::writing}, {SYS_renameat2, Action::writing},
    {SYS_utimensat, Action::writing}, {SYS_renameat, Action::writing},
#if defined(__x86_64__)
    {SYS_fork, Action::process},      {SYS_vfork, Action::process},
    {SYS_creat, Action::writing},     {SYS_mkdir, Action::writing},
    {SYS_rmdir, Action::writing},     {SYS_mknod, Action::writing},
    {SYS_unlink, Action::writing},    {SYS_rename, Action::writing},
    {SYS_link, Action::writing},      {SYS_symlink, Action::writing},
    {SYS_chmod, Action::writing},     {SYS_chown, Action::writing},
#endif
};

constexpr std::uint32_t kNeeded[] = {
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_write,
    SYS_writev,
    SYS_close,
    SYS_fstat,
    SYS_newfstatat,
    SYS_statx,
    SYS_lseek,
    SYS_mmap,
    SYS_mprotect,
    SYS_munmap,
    SYS_mremap,
    SYS_brk,
    SYS_madvise,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_faccessat,
    SYS_dup,
    SYS_dup3,
    SYS_nanosleep,
    SYS_clock_nanosleep,
    SYS_getpid,
    SYS_gettid,
    SYS_getppid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_exit,
    SYS_exit_group,
    SYS_futex,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_getrusage,
    SYS_times,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_gettimeofday,
    SYS_getcwd,
    SYS_readlinkat,
    SYS_getdents64,
    SYS_uname,
    SYS_sysinfo,
    SYS_set_robust_list,
    SYS_getrandom,
    SYS_membarrier,
    SYS_fcntl,
    SYS_fadvise64,
    SYS_restart_syscall,
    SYS_ppoll,
    SYS_getcpu,
    SYS_tgkill,
    // Sanitizers test whether memory can be read by writing it to a pipe.
    SYS_pipe2,
#ifdef SYS_rseq
    SYS_rseq,
#endif
#ifdef SYS_faccessat2
    SYS_faccessat2,
#endif
#if defined(__x86_64__)
    SYS_pipe,
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_dup2,
    SYS_readlink,
    SYS_arch_prctl,
    SYS_poll,
    SYS_time,
#endif
};

constexpr std::uint32_t kChanges = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC |
                                   O_APPEND | (O_TMPFILE & ~O_DIRECTORY);

using Program = std::vector<sock_filter>;

void add(Program& program, std::uint16_t code, std::uint32_t k,
         std::uint8_t jump_true = 0, std::uint8_t jump_false = 0) {
  program.push_back({code, jump_true, jump_false, k});
}

void load(Program& program, std::size_t offset) {
  add(program, BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}

void answer(Program& program, std::uint32_t action) {
  add(program, BPF_RET | BPF_K, action);
}

void answer_if_equal(Program& program, std::uint32_t value,
                     std::uint32_t action) {
  add(program, BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
  answer(program, action);
}

constexpr std::size_t low_half(std::size_t argument) {
  return offsetof(seccomp_data, args) + 8 * argument;  // little endian
}

/// If the call is `call`: decides by whether its argument has any of `bits`.
void choose_by_bits(Program& program, std::uint32_t call, std::size_t argument,
                    std::uint32_t bits, std::uint32_t with,
                    std::uint32_t without) {
  add(program, BPF_JMP | BPF_JEQ | BPF_K, call, 0, 4);
  load(program, low_half(argument));
  add(program, BPF_JMP | BPF_JSET | BPF_K, bits, 0, 1);
  answer(program, with);
  answer(program, without);
}

/// If the call is `call`: allowed if its argument is `value`, else `otherwise`.
void allow_only(Program& program, std::uint32_t call, std::size_t argument,
                std::uint32_t value, std::uint32_t otherwise) {
  add(program, BPF_JMP | BPF_JEQ | BPF_K, call, 0, 4);
  load(program, low_half(argument));
  add(program, BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
  answer(program, SECCOMP_RET_ALLOW);
  answer(program, otherwise);
}

std::uint32_t fails(int error) {
  return SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error);
}

Program make_program(Refusing refusing) {
  Program program;
  load(program, offsetof(seccomp_data, arch));
  add(program, BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0);
  answer(program, SECCOMP_RET_KILL_PROCESS);
  load(program, offsetof(seccomp_data, nr));
  const bool is_quiet = refusing == Refusing::quietly;
  const std::uint32_t refuse = is_quiet ? fails(EPERM) : SECCOMP_RET_TRAP;
  if (is_quiet) {
    answer_if_equal(program, SYS_prctl, SECCOMP_RET_ALLOW);
    // Gmsh asks for a larger stack as it starts.
    answer_if_equal(program, SYS_prlimit64, SECCOMP_RET_ALLOW);
  }
  choose_by_bits(program, SYS_openat, 2, kChanges, refuse, SECCOMP_RET_ALLOW);
#if defined(__x86_64__)
  choose_by_bits(program, SYS_open, 1, kChanges, refuse, SECCOMP_RET_ALLOW);
#endif
  // Threads are made by clone; glibc tries clone3 first, whose flags a filter
  // cannot see.
  choose_by_bits(program, SYS_clone, 0, CLONE_THREAD, SECCOMP_RET_ALLOW,
                 refuse);
  allow_only(program, SYS_ioctl, 1, TCGETS, fails(ENOTTY));
  allow_only(program, SYS_tgkill, 0, static_cast<std::uint32_t>(getpid()),
             fails(EPERM));
  // Limits may be read; the new ones are argument 2.
  allow_only(program, SYS_prlimit64, 2, 0, fails(EPERM));
  for (const Refusal& refusal : kRefusals) {
    answer_if_equal(program, refusal.call, refuse);
  }
  for (const std::uint32_t call : kNeeded) {
    answer_if_equal(program, call, SECCOMP_RET_ALLOW);
  }
  answer(program, fails(ENOSYS));
  return program;
}

const char* describe(int call) {
  for (const Refusal& refusal : kRefusals) {
    if (refusal.call != static_cast<std::uint32_t>(call)) continue;
    switch (refusal.deed) {
      case Action::program:
        return "run a program";
      case Action::process:
        return "start a process";
      case Action::writing:
        return "change a file or folder";
      case Action::network:
        return "use the network";
    }
  }
  return call == SYS_clone ? "start a process" : "write the file ";
}

/// The path argument of an open call.
const char* find_path(int call, const ucontext_t& context) {
#if defined(__x86_64__)
  const auto& registers = context.uc_mcontext.gregs;
  const auto value = registers[call == SYS_openat ? REG_RSI : REG_RDI];
  if (call != SYS_openat && call != SYS_open) return nullptr;
#elif defined(__aarch64__)
  const auto value = context.uc_mcontext.regs[1];
  if (call != SYS_openat) return nullptr;
#else
  const std::uintptr_t value = 0;
  static_cast<void>(call);
  static_cast<void>(context);
#endif
  // NOLINTNEXTLINE: a register holds the pointer
  return reinterpret_cast<const char*>(static_cast<std::uintptr_t>(value));
}

// In a signal handler: no allocation, no locks.
[[noreturn]] void end_refused(int, siginfo_t* info, void* context) {
  std::array<char, 600> text{};
  const char* path =
      find_path(info->si_syscall, *static_cast<const ucontext_t*>(context));
  std::strcpy(text.data(), describe(info->si_syscall));
  if (path) {
    std::strncat(text.data(), "'", 2);
    std::strncat(text.data(), path, 400);
    std::strncat(text.data(), "'", 2);
  }
  refuse(text.data());
}

}  // namespace

bool apply_seccomp(Refusing refusing) {
  if (kArchitecture == 0) return false;
  struct sigaction action {};
  action.sa_sigaction = end_refused;
  action.sa_flags = SA_SIGINFO;
  if (sigaction(SIGSYS, &action, nullptr) != 0) return false;
  Program program = make_program(refusing);
  const sock_fprog filter{static_cast<unsigned short>(program.size()),
                          program.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

}  // namespace limber::mesher
