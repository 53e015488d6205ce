// What a program needs at its start: a home folder, arguments in UTF-8.
#include <array>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iconv.h>
#include <map>
#include <optional>
#include <pwd.h>
#include <string>
#include <unistd.h>

#include "core/base/Printable.h"
#include "core/base/ProgramStart.h"
#include "core/base/Random.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class ProgramStart : public testing::Test {
protected:
    ProgramStart() {
        for (const char* name : {"HOME", "XDG_DATA_HOME"}) {
            const char* had = std::getenv(name);
            before_.emplace_back(name, had != nullptr ? std::optional<std::string>(had) : std::nullopt);
        }
    }
    ~ProgramStart() override {
        for (const auto& [name, value] : before_) value ? ::setenv(name, value->c_str(), 1) : ::unsetenv(name);
    }
    static std::optional<std::string> start(const std::string& word = "measure") {
        const std::array<const char*, 2> words{"tactoscope-cli", word.c_str()};
        return refusedStart(2, words.data());
    }

private:
    std::vector<std::pair<const char*, std::optional<std::string>>> before_;
};

TEST_F(ProgramStart, AHomeThatIsAFolderStays) {
    ::setenv("HOME", "/home/al", 1);
    EXPECT_EQ(start(), std::nullopt);
    EXPECT_STREQ(std::getenv("HOME"), "/home/al");
}

TEST_F(ProgramStart, WithoutAHomeItIsThatOfTheAccount) {
    const passwd* account = ::getpwuid(::getuid());
    for (const char* none : {static_cast<const char*>(nullptr), "", ".", "data"}) {
        none != nullptr ? ::setenv("HOME", none, 1) : ::unsetenv("HOME");
        ::unsetenv("XDG_DATA_HOME");
        const auto refused = start();
        if (account != nullptr) {
            EXPECT_EQ(refused, std::nullopt);
            EXPECT_STREQ(std::getenv("HOME"), account->pw_dir);
        } else {
            ASSERT_TRUE(refused);
            EXPECT_THAT(*refused, HasSubstr("HOME is"));
        }
    }
}

/// The C library's own decoder, which rejects surrogates and overlong characters.
bool isUtf8ForTheCLibrary(std::string text) {
    const auto decoder = ::iconv_open("UTF-32LE", "UTF-8");
    std::array<char, 4096> out{};
    char* from = text.data();
    char* to = out.data();
    std::size_t left = text.size(), room = out.size();
    const bool whole = ::iconv(decoder, &from, &left, &to, &room) != static_cast<std::size_t>(-1) && left == 0;
    ::iconv_close(decoder);
    return whole;
}

TEST_F(ProgramStart, AnArgumentThatIsNotUtf8IsNamedWithItsBytes) {
    ::setenv("HOME", "/home/al", 1);
    const auto refused = start("caf\xE9.csv");
    ASSERT_TRUE(refused);
    EXPECT_THAT(*refused, HasSubstr("\"caf\\xe9.csv\" is not UTF-8"));
    Random random(20261129, "names");
    const std::string pieces[] = {
        "a", "é", "µ", "語", "😀", "\xC3", "\xA9", "\xFF", "\xED\xA0\x80", "\xC0\xAF", "\xF4\x90\x80\x80"};
    std::size_t refusals = 0;
    for (int k = 0; k < 2000; ++k) {
        std::string name;
        const auto wanted = 1 + random.below(255);
        while (name.size() < wanted) name += pieces[random.below(random.below(60) == 0 ? std::size(pieces) : 5)];
        EXPECT_EQ(!start(name), isUtf8ForTheCLibrary(name)) << printable(name);
        EXPECT_EQ(isUtf8(name), isUtf8ForTheCLibrary(name)) << printable(name);
        refusals += start(name) ? 1U : 0U;
    }
    EXPECT_GT(refusals, 200U);
    EXPECT_LT(refusals, 1900U);
}

// User files lie in the folder that the environment names.

class DataFolder : public testing::Test {
protected:
    ~DataFolder() override {
        for (const auto& [name, value] : before_) set(name, value ? value->c_str() : nullptr);
    }
    void say(const char* name, const char* value) {
        const char* had = std::getenv(name);
        before_.try_emplace(name, had != nullptr ? std::optional<std::string>(had) : std::nullopt);
        set(name, value);
    }

private:
    static void set(const char* name, const char* value) {
        value != nullptr ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    std::map<const char*, std::optional<std::string>> before_;
};

TEST_F(DataFolder, IsWhatTheEnvironmentNamesElseInTheHomeFolder) {
    say("HOME", "/home/al");
    say("XDG_DATA_HOME", "/data");
    EXPECT_EQ(dataFolder(), "/data/tactoscope");
    for (const char* none : {static_cast<const char*>(nullptr), "", "relative"}) {
        say("XDG_DATA_HOME", none);
        EXPECT_EQ(dataFolder(), "/home/al/.local/share/tactoscope");
    }
}

TEST_F(DataFolder, IsRelativeOnlyWithoutAHome) {
    say("XDG_DATA_HOME", nullptr);
    say("HOME", nullptr);
    EXPECT_TRUE(dataFolder().is_relative());
}

}  // namespace
}  // namespace tacto::test
