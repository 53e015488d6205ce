// Where the user's files lie, as the environment says.
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <string>

#include "core/base/DataFolder.h"

namespace tacto::test {
namespace {

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
