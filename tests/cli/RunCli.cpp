#include "tests/cli/RunCli.h"

#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace tacto::test {

namespace {

std::vector<char*> pointersTo(Words& words) {
    std::vector<char*> pointers;
    for (auto& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

}  // namespace

std::string contentOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
}

Words Desk::environment(const std::string& preloaded) const {
    Words kept;
    auto libraries = preloaded;
    if (passphrasesAreCheap_) libraries += ":" TACTO_CHEAP_PASSPHRASE_LIBRARY;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text(*entry);
        const auto is = [&](std::string_view name) { return text.starts_with(name); };
        constexpr std::string_view kPreload = "LD_PRELOAD=";
        if (is(kPreload)) libraries.insert(0, std::string(text.substr(kPreload.size())) + ':');
        if (is(kPreload) || is("DISPLAY=") || is("WAYLAND_DISPLAY=") || is("QT_") || is("XDG_") || is("HOME="))
            continue;
        kept.emplace_back(text);
    }
    kept.push_back("LD_PRELOAD=" + libraries);
    kept.push_back("HOME=" + home_.path().string());
    kept.push_back("XDG_DATA_HOME=" + (home_.path() / "data").string());
    return kept;
}

pid_t Desk::spawn(const Words& words, posix_spawn_file_actions_t& actions, short flags) const {
    posix_spawn_file_actions_addchdir_np(&actions, path().c_str());
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigset_t mask = defaults;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&defaults, signal);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setsigmask(&attributes, &mask);
    posix_spawnattr_setflags(&attributes, static_cast<short>(flags | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK));
    Words command{TACTO_CLI};
    command.insert(command.end(), words.begin(), words.end());
    auto kept = environment();
    pid_t pid = -1;
    const int failed =
        posix_spawn(&pid, TACTO_CLI, &actions, &attributes, pointersTo(command).data(), pointersTo(kept).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error(std::string(TACTO_CLI " cannot be started: ") + std::strerror(failed));
    return pid;
}

Desk::Started::Started(const Desk& desk, const Words& words)
    : out_(desk.streams_.path() / (std::to_string(desk.count_) + ".out")),
      err_(desk.streams_.path() / (std::to_string(desk.count_) + ".err")) {
    ++desk.count_;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_ = desk.spawn(words, actions);
    ended_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
    if (ended_ < 0) throw std::runtime_error("pidfd_open failed");
}

Desk::Started::~Started() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(ended_);
}

bool Desk::Started::endedWithin(std::chrono::milliseconds time) const {
    pollfd watched{ended_, POLLIN, 0};
    return poll(&watched, 1, static_cast<int>(time.count())) == 1;
}

bool Desk::Started::waitUntil(const std::function<bool()>& isSo) const {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!isSo()) {
        if (endedWithin(std::chrono::milliseconds(2)) || std::chrono::steady_clock::now() > limit) return isSo();
    }
    return true;
}

void Desk::Started::signal(int number) const { kill(pid_, number); }

Ran Desk::Started::wait(std::chrono::seconds limit) {
    if (!endedWithin(limit)) kill(pid_, SIGKILL);
    int status = 0;
    rusage used{};
    wait4(pid_, &status, 0, &used);
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), contentOf(out_), contentOf(err_),
            used.ru_maxrss};
}

std::string Desk::write(std::string_view name, std::string_view content) const {
    std::filesystem::create_directories((path() / name).parent_path());
    return folder_.write(name, content).string();
}

std::string Desk::protocol(std::string_view name, std::string_view script) const {
    const auto folder = std::filesystem::path("data") / "tactoscope" / "protocols";
    std::filesystem::create_directories(home_.path() / folder);
    return home_.write((folder / name).string(), script).string();
}

std::map<std::string, std::string> Desk::files(std::string_view below) const {
    std::map<std::string, std::string> found;
    if (!std::filesystem::exists(path() / below)) return found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path() / below)) {
        if (entry.is_regular_file()) found[entry.path().lexically_normal().string()] = contentOf(entry.path());
    }
    return found;
}

Words Desk::named(std::string_view below, std::string_view ending) const {
    Words found;
    if (!std::filesystem::exists(path() / below)) return found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path() / below)) {
        if (entry.path().string().ends_with(ending)) found.push_back(entry.path().lexically_normal().string());
    }
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace tacto::test
