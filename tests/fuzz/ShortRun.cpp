// The short run of a fuzz target in ordinary builds, without clang:
//   fuzzed TARGET CORPUS_FOLDER [--dictionary FILE] [--inputs N] [--seconds S] [--seed K]
//   fuzzed TARGET FILE          one input again
// Runs every file of the folder, then N inputs made from these files and the dictionary's words (default 20000; in
// campaigns and with a sanitizer 200000), until S seconds are over (1; with a sanitizer 3). Without --seed each run
// draws a seed and prints it.
//
// The inputs run in a separate process and lie in memory that both processes share. An input that kills its process in
// any way (a failed check, a sanitizer, no memory) or never ends is thus kept: it is saved as fuzzed-TARGET.crash next
// to the program, and the run fails.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/Mutation.h"
#include "tests/support/Trials.h"

namespace {

using tacto::fuzz::Bytes;
using tacto::fuzz::Target;

/// An input that takes longer hangs. A normal input takes milliseconds, even with a sanitizer on a busy machine.
constexpr unsigned kMaxInput_s = 20;
constexpr int kMisused = 2;

#ifdef TACTOSCOPE_SANITIZED
constexpr std::uint64_t kSeconds = 3;
constexpr std::uint64_t kInputs = 200'000;
#else
// In CI only the run with the address sanitizer is long.
const auto kSeconds = tacto::test::trials<std::uint64_t>({.local = 1, .ci = 1, .campaign = 30});
const auto kInputs = tacto::test::trials<std::uint64_t>({.local = 20'000, .ci = 20'000, .campaign = 200'000});
#endif

struct Options {
    std::string name;
    Target target = nullptr;
    std::filesystem::path inputs;
    std::filesystem::path dictionary;
    std::uint64_t count = kInputs;
    std::uint64_t seconds = kSeconds;
    std::uint64_t seed = std::random_device{}();
};

/// What the process with the inputs leaves behind when it dies.
struct Shared {
    std::uint64_t corpus;
    std::uint64_t mutated;
    std::size_t size;
    std::uint8_t input[tacto::fuzz::kMaxFile];
};

std::optional<Options> optionsFrom(int count, char** words) {
    if (count < 3 || count % 2 == 0) return std::nullopt;
    Options options;
    options.name = words[1];
    const auto found = tacto::fuzz::targets().find(options.name);
    if (found == tacto::fuzz::targets().end()) return std::nullopt;
    options.target = found->second;
    options.inputs = words[2];
    for (int i = 3; i < count; i += 2) {
        const std::string_view name = words[i];
        const std::string_view text = words[i + 1];
        if (name == "--dictionary") {
            options.dictionary = text;
            continue;
        }
        std::uint64_t* const into = name == "--inputs"    ? &options.count
                                    : name == "--seconds" ? &options.seconds
                                    : name == "--seed"    ? &options.seed
                                                          : nullptr;
        if (into == nullptr) return std::nullopt;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), *into);
        if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
    }
    return options;
}

/// Returns the file, or all files of the folder by name. An empty folder is an error: nothing would be tested.
std::vector<Bytes> corpusAt(const std::filesystem::path& where) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    if (std::filesystem::is_regular_file(where, error)) files.push_back(where);
    for (std::filesystem::directory_iterator entry(where, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->is_regular_file(error)) files.push_back(entry->path());
    }
    std::ranges::sort(files);
    std::vector<Bytes> corpus;
    for (const auto& file : files) {
        std::ifstream stream(file, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
        if (!stream || corpus.back().size() > tacto::fuzz::kMaxFile) {
            std::fprintf(stderr, "%s: cannot be read, or has more than %zu bytes\n", file.c_str(),
                         tacto::fuzz::kMaxFile);
            std::exit(kMisused);
        }
    }
    return corpus;
}

std::optional<std::vector<Bytes>> wordsAt(const std::filesystem::path& dictionary) {
    if (dictionary.empty()) return std::vector<Bytes>();
    std::ifstream stream(dictionary, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) return std::nullopt;
    return tacto::fuzz::dictionaryFrom(text);
}

void run(Target target, const Bytes& input, Shared& shared) {
    shared.size = input.size();
    std::ranges::copy(input, shared.input);
    ::alarm(kMaxInput_s);
    // A copy of exactly this size, so that a sanitizer notices reads beyond the end.
    const Bytes exact(input);
    target(exact.data(), exact.size());
    ::alarm(0);
}

/// Runs all inputs in the process that may die.
void runAll(const std::vector<Bytes>& corpus, const std::vector<Bytes>& words, const Options& options, Shared& shared) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(options.seconds);
    for (const auto& input : corpus) {
        run(options.target, input, shared);
        ++shared.corpus;
    }
    if (!std::filesystem::is_directory(options.inputs)) return;
    tacto::Random random(options.seed, "fuzz");
    while (shared.mutated < options.count && std::chrono::steady_clock::now() < end) {
        run(options.target, tacto::fuzz::mutated(corpus, words, random), shared);
        ++shared.mutated;
    }
}

/// Saves the input, prints what happened and where the input is, and fails the run.
int keep(const Shared& shared, int status, const Options& options, const std::filesystem::path& program) {
    auto file = program;
    file += '-' + options.name + ".crash";
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(shared.input), static_cast<std::streamsize>(shared.size));
    std::string how = "ended the process with status " + std::to_string(WEXITSTATUS(status));
    if (WIFSIGNALED(status)) how = std::string("died: ") + strsignal(WTERMSIG(status));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
        how = "took longer than " + std::to_string(kMaxInput_s) + " s";
    }
    std::fprintf(
        stderr,
        "After %llu files and %llu inputs made of them (seed %llu): an input of %zu bytes %s.\nAgain: %s %s %s\n",
        static_cast<unsigned long long>(shared.corpus), static_cast<unsigned long long>(shared.mutated),
        static_cast<unsigned long long>(options.seed), shared.size, how.c_str(), program.c_str(), options.name.c_str(),
        file.c_str());
    return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = optionsFrom(argc, argv);
    if (!options) {
        std::fprintf(stderr,
                     "Usage: %s TARGET CORPUS_FOLDER|FILE [--dictionary FILE] [--inputs N] [--seconds S] [--seed K]\n"
                     "Targets:",
                     argv[0]);
        for (const auto& [name, target] : tacto::fuzz::targets()) std::fprintf(stderr, " %s", name.c_str());
        std::fprintf(stderr, "\n");
        return kMisused;
    }
    const auto corpus = corpusAt(options->inputs);
    if (corpus.empty()) {
        std::fprintf(stderr, "%s: expected a file, or a folder with at least one\n", options->inputs.c_str());
        return kMisused;
    }
    const auto words = wordsAt(options->dictionary);
    if (!words) {
        std::fprintf(stderr, "%s: a dictionary with a line \"word\" or name=\"word\" each was expected\n",
                     options->dictionary.c_str());
        return kMisused;
    }
    void* const memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
        std::perror("mmap");
        return kMisused;
    }
    auto& shared = *static_cast<Shared*>(memory);
    const pid_t child = ::fork();
    if (child < 0) {
        std::perror("fork");
        return kMisused;
    }
    if (child == 0) {
        runAll(corpus, *words, *options, shared);
        std::exit(EXIT_SUCCESS);  // unlike _exit, this checks for leaks
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS) return keep(shared, status, *options, argv[0]);
    std::printf("%llu files, %llu inputs made of them (seed %llu)\n", static_cast<unsigned long long>(shared.corpus),
                static_cast<unsigned long long>(shared.mutated), static_cast<unsigned long long>(options->seed));
    return EXIT_SUCCESS;
}
