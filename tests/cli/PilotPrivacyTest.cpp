// Files in the study, the user's home and the temporary folder during a session, after its program was killed, and
// after its end contain no code, name, birth year or note, and no condition or answer.
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/PilotDesk.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

class PilotPrivacy : public testing::Test {
protected:
    PilotPrivacy() {
        fs::create_directory(desk.desk().at("temporary"));
        ::setenv("TMPDIR", desk.desk().at("temporary").c_str(), 1);
    }
    ~PilotPrivacy() override {
        if (before.empty())
            ::unsetenv("TMPDIR");
        else
            ::setenv("TMPDIR", before.c_str(), 1);
    }
    PilotPrivacy(const PilotPrivacy&) = delete;
    PilotPrivacy& operator=(const PilotPrivacy&) = delete;

    Ran study(Words words) const {
        const auto ran = desk.desk().run(Words{"study"} + words + Words{"--passphrase-file", passphrase, "--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran;
    }
    /// Returns every file that the program could have written, with its contents.
    [[nodiscard]] std::map<std::string, std::string> written() const {
        auto all = desk.desk().files("study");
        all.merge(desk.desk().files("temporary"));
        for (const auto& variable : desk.desk().environment()) {
            if (!variable.starts_with("HOME=")) continue;
            for (const auto& entry : fs::recursive_directory_iterator(variable.substr(5)))
                if (entry.is_regular_file()) all[entry.path().string()] = contentOf(entry.path());
        }
        return all;
    }
    void expectNothingSaid(const Words& secrets) const {
        const auto all = written();
        EXPECT_GT(all.size(), 3U);
        for (const auto& [file, bytes] : all)
            for (const auto& secret : secrets)
                EXPECT_EQ(bytes.find(secret), std::string::npos) << "\"" << secret << "\" stands in " << file;
    }

    const std::string before = std::getenv("TMPDIR") == nullptr ? "" : std::getenv("TMPDIR");
    const PilotDesk desk;
    const std::string passphrase = desk.desk().write("passphrase", "correct horse 4711\n");
};

TEST_F(PilotPrivacy, NothingOfAPersonStandsInAnyFileBeforeDuringOrAfterASession) {
    RecordProperty("hazard", "H11");
    const auto at = desk.desk().at("study");
    study({"create", at, "--title", "Four conditions", "--approval", "EC-17", "--from", "2026-01-01", "--expires",
           "2099-12-31", "--consent-version", "2", "--set", "blocks=2"});
    const auto code = jsonOf(study({"enrol", at, "--virtual", "7"}))["code"].get<std::string>();
    study({"consent", at, code, "--version", "2", "--date", "2026-11-20", "--by", "Klara Beispiel"});
    Words secrets{code,       "Klara Beispiel", "correct horse", "rough-high", "smooth-low",
                  "not-sure", "too-strong",     "current_ma",    "\"rt_s\"",   "virtual:7"};
    expectNothingSaid(secrets);

    const Words notes{"--operator", "Maria Muster", "--sample", "born 1987", "--ambient", "she is tired"};
    secrets = secrets + Words{"Maria Muster", "born 1987", "she is tired"};
    const auto words = Words{"--set", "participant=" + code, "--passphrase-file", passphrase} + notes;
    ASSERT_EQ(desk.runKilled(250, "pilot-identification", words), -9);
    bool log = false;
    for (const auto& [file, bytes] : written()) log = log || (file.ends_with(".tacto-wal") && bytes.size() > 10'000);
    EXPECT_TRUE(log) << "the log of the program that was killed is there to be read";
    expectNothingSaid(secrets);

    const auto ran = desk.run("pilot-identification", words + Words{"--set", "unfinished=resume"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto session = jsonOf(study({"show", at}))["sessions"][0]["id"].get<std::string>();
    study({"adverse-event", at, session, "--what", "Ms Muster fainted", "--severity", "2", "--relation", "3"});
    secrets.emplace_back("Ms Muster fainted");
    const auto shared = desk.desk().at("exported by Maria Muster");
    ASSERT_EQ(
        desk.desk().run({"export", at, "--format", "bids", "--out", shared, "--passphrase-file", passphrase}).code, 0);
    expectNothingSaid(secrets);
    const auto events = jsonOf(ran)["results"]["participant"]["code"];
    EXPECT_EQ(events, code) << "and with the key it is read";
}

}  // namespace
}  // namespace tacto::test
