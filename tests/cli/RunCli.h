// RunCli.h - runs the built tactoscope-cli as a user does, without a display, and returns its output.
//
// Thread-safety: the test's own thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <spawn.h>
#include <string>
#include <sys/types.h>
#include <vector>

#include "tests/support/Support.h"

namespace tacto::test {

using Words = std::vector<std::string>;

struct Ran {
    int code = 0;       ///< exit code; if a signal ended the program, minus its number
    std::string out;    ///< stdout
    std::string err;    ///< stderr
    long most_KiB = 0;  ///< highest memory use
};

/// A user's folder with its own home: nothing outside it is written.
class Desk {
public:
    /// A program that was started here, which can be signalled and waited for.
    class Started {
    public:
        ~Started();
        Started(const Started&) = delete;
        Started& operator=(const Started&) = delete;
        /// Returns false if the program ended first, or after 20 s.
        [[nodiscard]] bool waitUntil(const std::function<bool()>& isSo) const;
        void signal(int number) const;
        /// Waits for the program to end. After `limit` the program is killed and its exit code is -9.
        [[nodiscard]] Ran wait(std::chrono::seconds limit = std::chrono::seconds(120));

    private:
        friend class Desk;
        Started(const Desk& desk, const Words& words);
        [[nodiscard]] bool endedWithin(std::chrono::milliseconds time) const;
        std::filesystem::path out_, err_;
        pid_t pid_ = -1;
        int ended_ = -1;  // a descriptor that becomes readable when the program has ended
    };

    [[nodiscard]] Ran run(const Words& words) const { return start(words).wait(); }
    [[nodiscard]] Started start(const Words& words) const { return {*this, words}; }

    /// Starts the program with these streams, and with signals as in a terminal, whatever the test's own parent ignores
    /// or blocks. Destroys `actions`.
    [[nodiscard]] pid_t spawn(const Words& words, posix_spawn_file_actions_t& actions, short flags = 0) const;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
    /// Returns the program's environment: no display, none of the tester's own settings, the desk's home, and preloaded
    /// libraries, separated by ':'.
    [[nodiscard]] Words environment(const std::string& preloaded = {}) const;
    /// From here on, deriving a key from a passphrase costs as much as in the program; before, as little as possible.
    void payForPassphrases() { passphrasesAreCheap_ = false; }
    /// Returns a path inside the folder as text.
    [[nodiscard]] std::string at(std::string_view name) const { return (path() / name).string(); }
    std::string write(std::string_view name, std::string_view content) const;
    /// Puts a script where the program looks for the user's protocols; returns its path.
    std::string protocol(std::string_view name, std::string_view script) const;
    /// Returns every file inside a folder of the desk, with its contents.
    [[nodiscard]] std::map<std::string, std::string> files(std::string_view below = ".") const;
    /// Returns the files inside a folder with names that end like this, sorted.
    [[nodiscard]] Words named(std::string_view below, std::string_view ending) const;

private:
    ScratchDir folder_;
    ScratchDir home_;
    ScratchDir streams_;
    mutable int count_ = 0;
    bool passphrasesAreCheap_ = true;
};

[[nodiscard]] std::string contentOf(const std::filesystem::path& file);

}  // namespace tacto::test
