// FirstWindow.cpp - the time from exec to the painted window, compared with another program's, on a separate X server
// (Xvfb) with warm caches and a fresh home each time. Median of 5, the programs taking turns.
//
// The server keeps its screen in a file; a window counts as painted when a tenth of the screen differs from the empty
// screen. So only the program and the server work during the wait, and a mapped but unpainted window does not count.
//
//   perf_first_window PROGRAM [BASELINE]    a baseline that is not installed is not compared
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "tests/perf/Verdict.h"

namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kRounds = 5;
constexpr auto kLimit = std::chrono::seconds(20);
constexpr const char* kScreen = "1440x900x24";

/// Starts a program and discards its output. `descriptor` becomes the program's descriptor 3; -1 for none.
pid_t start(const std::vector<std::string>& words, int descriptor = -1) {
    std::vector<char*> arguments;
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
    if (descriptor >= 0) dup2(descriptor, 3);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

void end(pid_t child) {
    kill(child, SIGTERM);
    for (int i = 0; i < 200; ++i) {
        if (waitpid(child, nullptr, WNOHANG) == child) return;
        std::this_thread::sleep_for(milliseconds(10));
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
}

/// An X server and access to its screen, an XWD file in shared memory.
class Server {
public:
    explicit Server(const fs::path& folder) {
        int ready[2];
        if (pipe(ready) != 0) return;
        server_ = start({"Xvfb", "-displayfd", "3", "-screen", "0", kScreen, "-fbdir", folder.string(), "-nolisten",
                         "tcp", "-noreset"},
                        ready[1]);
        close(ready[1]);
        // Reads to the end of the line, since the server ends if nobody reads its number.
        std::string digits;
        for (char digit = 0; read(ready[0], &digit, 1) == 1 && digit != '\n';) digits += digit;
        close(ready[0]);
        if (digits.empty()) return;
        setenv("DISPLAY", (":" + digits).c_str(), 1);
        const auto file = folder / "Xvfb_screen0";
        const int descriptor = open(file.c_str(), O_RDONLY);
        if (descriptor < 0) return;
        bytes_ = fs::file_size(file);
        void* mapped = mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, descriptor, 0);
        close(descriptor);
        if (mapped == MAP_FAILED) return;
        screen_ = static_cast<const unsigned char*>(mapped);
        bare_ = sampled();
    }
    ~Server() {
        if (screen_ != nullptr) munmap(const_cast<unsigned char*>(screen_), bytes_);
        if (server_ > 0) end(server_);
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    [[nodiscard]] bool runs() const { return screen_ != nullptr; }
    /// Returns the part of the screen, 0 to 1, that differs from the empty screen.
    [[nodiscard]] double painted() const {
        const auto now = sampled();
        std::size_t other = 0;
        for (std::size_t i = 0; i < now.size(); ++i) other += now[i] != bare_[i] ? 1 : 0;
        return static_cast<double>(other) / static_cast<double>(now.size());
    }

private:
    /// Returns a word of the file's header: 32-bit words, big-endian.
    [[nodiscard]] std::size_t word(std::size_t index) const {
        const auto* at = screen_ + 4 * index;
        return (std::size_t{at[0]} << 24) | (std::size_t{at[1]} << 16) | (std::size_t{at[2]} << 8) | at[3];
    }
    /// Returns one pixel of every 16 by 16.
    [[nodiscard]] std::vector<std::uint32_t> sampled() const {
        const std::size_t width = word(4), height = word(5), row = word(12);
        const auto* pixels = screen_ + word(0) + 12 * word(19);  // header, then colours of 12 bytes each
        std::vector<std::uint32_t> all;
        for (std::size_t y = 8; y < height; y += 16) {
            for (std::size_t x = 8; x < width; x += 16) {
                const auto* at = pixels + y * row + 4 * x;
                all.push_back(std::uint32_t{at[0]} | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16);
            }
        }
        return all;
    }
    pid_t server_ = -1;
    const unsigned char* screen_ = nullptr;
    std::size_t bytes_ = 0;
    std::vector<std::uint32_t> bare_;
};

bool waitFor(const Server& server, bool painted) {
    const auto until = steady_clock::now() + kLimit;
    while ((server.painted() >= 0.1) != painted) {
        if (steady_clock::now() > until) return false;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
}

/// Returns the time in seconds; nothing if no window appeared.
std::optional<double> firstWindow(const Server& server, const std::string& program, const fs::path& scratch) {
    static int number = 0;
    const auto home = scratch / ("home-" + std::to_string(++number));
    fs::create_directories(home);
    fs::permissions(home, fs::perms::owner_all);  // as required for a runtime folder
    for (const char* name : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
        setenv(name, home.c_str(), 1);
    const auto begun = steady_clock::now();
    const pid_t child = start({program});
    const bool came = waitFor(server, true);
    const double seconds = std::chrono::duration<double>(steady_clock::now() - begun).count();
    end(child);
    const bool gone = waitFor(server, false);
    std::this_thread::sleep_for(milliseconds(300));  // time for the rest of its shutdown
    return came && gone ? std::optional(seconds) : std::nullopt;
}

bool isInstalled(const std::string& program) {
    if (program.find('/') != std::string::npos) return access(program.c_str(), X_OK) == 0;
    const char* path = std::getenv("PATH");
    std::string folders = path == nullptr ? "" : path;
    for (std::size_t from = 0; from <= folders.size();) {
        const auto to = std::min(folders.find(':', from), folders.size());
        if (access((fs::path(folders.substr(from, to - from)) / program).c_str(), X_OK) == 0) return true;
        from = to + 1;
    }
    return false;
}

struct Times {
    double median = 0, least = 0, most = 0;
};
Times timesOf(std::vector<double> seconds) {
    std::sort(seconds.begin(), seconds.end());
    return {seconds[seconds.size() / 2], seconds.front(), seconds.back()};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) {
        std::fprintf(stderr, "usage: perf_first_window PROGRAM [BASELINE]\n");
        return 2;
    }
    if (!isInstalled("Xvfb")) {
        std::printf("window on screen: not measured, Xvfb is not installed\n");
        return 0;
    }
    std::vector<std::string> programs{argv[1]};
    const bool compared = argc == 3 && isInstalled(argv[2]);
    if (compared) programs.push_back(argv[2]);
    const auto scratch = fs::temp_directory_path() / ("tactoscope-first-window-" + std::to_string(getpid()));
    fs::create_directories(scratch / "screen");
    setenv("QT_QPA_PLATFORM", "xcb", 1);
    unsetenv("WAYLAND_DISPLAY");
    int exitCode = 0;
    {
        const Server server(scratch / "screen");
        std::vector<std::vector<double>> taken(programs.size());
        for (int round = -1; server.runs() && round < kRounds && exitCode == 0; ++round) {  // round -1 warms the caches
            for (std::size_t i = 0; i < programs.size(); ++i) {
                const auto seconds = firstWindow(server, programs[i], scratch);
                if (!seconds) {
                    std::printf("window on screen: not measured, %s showed none\n", programs[i].c_str());
                    exitCode = 1;
                } else if (round >= 0) {
                    taken[i].push_back(*seconds);
                }
            }
        }
        if (!server.runs()) {
            std::printf("window on screen: not measured, Xvfb does not start\n");
            exitCode = 1;
        }
        if (exitCode == 0) {
            std::printf("%-44s %8s %8s %8s\n", "exec to window painted, 5 starts", "median s", "least", "most");
            const auto ours = timesOf(taken[0]);
            std::optional<Times> theirs;
            if (compared) theirs = timesOf(taken[1]);
            if (theirs)
                std::printf("  %-42s %8.3f %8.3f %8.3f  baseline\n", argv[2], theirs->median, theirs->least,
                            theirs->most);
            std::printf("  %-42s %8.3f %8.3f %8.3f  ", "tactoscope", ours.median, ours.least, ours.most);
            if (theirs)
                std::printf("%s\n", tacto::verdict(ours.median / theirs->median, argv[2], 1).c_str());
            else
                std::printf("not compared: %s is not installed\n", argc == 3 ? argv[2] : "a baseline");
        }
    }
    std::error_code ignored;
    fs::remove_all(scratch, ignored);
    return exitCode;
}
