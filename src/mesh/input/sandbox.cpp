#include "mesh/input/sandbox.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>

#include "mesh/input/helper_io.hpp"

namespace elastolab {

namespace {

void allow_reading_below(int ruleset, const std::filesystem::path& folder) {
    const int fd = ::open(folder.c_str(), O_PATH | O_CLOEXEC);
    if (fd < 0) return;
    landlock_path_beneath_attr rule{};
    rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
    rule.parent_fd = fd;
    ::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
    ::close(fd);
}

void restrict_files(const std::vector<std::filesystem::path>& readable_folders) {
    const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1) return;
    landlock_ruleset_attr handled{};
    handled.handled_access_fs = (std::uint64_t{1} << 13) - 1;               // all of its first version
    if (version >= 2) handled.handled_access_fs |= std::uint64_t{1} << 13;  // to link or rename elsewhere
    if (version >= 3) handled.handled_access_fs |= std::uint64_t{1} << 14;  // to truncate
    const auto ruleset = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &handled, sizeof(handled), 0));
    if (ruleset < 0) return;
    for (const auto& folder : readable_folders) allow_reading_below(ruleset, folder);
    ::syscall(SYS_landlock_restrict_self, ruleset, 0);
    ::close(ruleset);
}

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

/// What the C and C++ libraries call to read files, to have memory and to end.
constexpr std::array kAllowedCalls = {
    SYS_read,          SYS_pread64,      SYS_readv,          SYS_write,           SYS_writev,
    SYS_close,         SYS_fstat,        SYS_newfstatat,     SYS_statx,           SYS_lseek,
    SYS_fcntl,         SYS_getdents64,   SYS_readlinkat,     SYS_faccessat,       SYS_getcwd,
    SYS_mmap,          SYS_munmap,       SYS_mprotect,       SYS_mremap,          SYS_madvise,
    SYS_brk,           SYS_futex,        SYS_getrandom,      SYS_getpid,          SYS_gettid,
    SYS_tgkill,        SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_rt_sigreturn,    SYS_sigaltstack,
    SYS_clock_gettime, SYS_gettimeofday, SYS_sched_yield,    SYS_clock_nanosleep, SYS_restart_syscall,
    SYS_exit,          SYS_exit_group,   SYS_sysinfo,        SYS_uname,
#if defined(__x86_64__)
    SYS_stat,          SYS_lstat,        SYS_access,         SYS_readlink,        SYS_time,
#endif
};

constexpr sock_filter load(std::size_t offset) {
    return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
constexpr sock_filter answer(std::uint32_t action) { return BPF_STMT(BPF_RET | BPF_K, action); }
/// Skips if_true instructions when the loaded number is (or, with JSET, has bits of) `value`, else if_false.
constexpr sock_filter jump(std::uint16_t test, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
    return BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), value, if_true, if_false);
}

std::vector<sock_filter> call_filter() {
    constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
    constexpr std::uint32_t kWriting = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
    std::vector<sock_filter> filter{load(offsetof(seccomp_data, arch)), jump(BPF_JEQ, kArchitecture, 1, 0),
                                    answer(kRefuse), load(offsetof(seccomp_data, nr))};
    for (const long call : kAllowedCalls) {
        filter.push_back(jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, 1));
        filter.push_back(answer(SECCOMP_RET_ALLOW));
    }
    filter.push_back(jump(BPF_JEQ, SYS_openat, 0, 3));
    filter.push_back(load(offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t)));  // low half: little-endian
    filter.push_back(jump(BPF_JSET, kWriting, 1, 0));
    filter.push_back(answer(SECCOMP_RET_ALLOW));
    filter.push_back(answer(kRefuse));
    return filter;
}

void restrict_calls() {
    if (kArchitecture == 0) return;
    std::vector<sock_filter> filter = call_filter();
    const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
    ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

}  // namespace

void enter_sandbox(const std::vector<std::filesystem::path>& readable_folders) {
    if (kSanitized) return;
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    restrict_files(readable_folders);
    restrict_calls();
}

}  // namespace elastolab
