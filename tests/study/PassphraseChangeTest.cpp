// How a study's passphrase is judged and changed.
#include <algorithm>
#include <random>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/study/StudySupport.h"
#include "tests/support/Refused.h"

namespace tacto {
namespace {

using Desk = test::StudyDesk;

constexpr const char* kNextWords = "kettle river 3094 lamp";

bool isStrong(const std::string& text, std::string_view known = {}) {
    return Passphrase::from(text).value().checkStrength(known).has_value();
}

TEST(PassphraseStrength, WhatAGuesserTriesFirstIsWeakAndWhatIsDrawnIsStrong) {
    RecordProperty("hazard", "H11");
    std::mt19937 random(49);
    const auto below = [&](std::size_t n) { return random() % n; };
    constexpr std::string_view kCommon[] = {"password", "letmein", "dragon", "monkey", "qwertyuiop", "sunshine"};
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    for (int i = 0; i < 200; ++i) {
        const std::string common(kCommon[below(std::size(kCommon))]);
        EXPECT_FALSE(isStrong(common + std::to_string(below(100)))) << common;
        EXPECT_FALSE(isStrong(std::string(1 + below(60), kLetters[below(kLetters.size())]))) << "one letter, repeated";
        EXPECT_FALSE(isStrong(fmt::format("{:02}.{:02}.{}", 1 + below(28), 1 + below(12), 1930 + below(90))))
            << "a day";
        std::string few, many;
        while (few.size() < 5) few += kLetters[below(kLetters.size())];
        while (many.size() < 14) many += kLetters[below(kLetters.size())];
        EXPECT_FALSE(isStrong(few)) << few;
        EXPECT_TRUE(isStrong(many)) << many;
        EXPECT_TRUE(isStrong(many + std::string(below(4000), 'x'))) << "however long";
    }
    EXPECT_FALSE(isStrong("Feelable Gribbles 26", "Feelable Gribbles")) << "its title is known to everyone";
    EXPECT_FALSE(isStrong("Tactoscope1"));
    EXPECT_TRUE(isStrong(test::kPassphraseText));
}

TEST_F(Desk, AWeakPassphraseMakesNoStudyAndTakesNoPlace) {
    RecordProperty("hazard", "H11");
    const auto weak = test::somePassphrase("summer 2026");
    EXPECT_THAT(Study::create(folder(), test::someStudy(), weak, around()),
                test::refused(ErrorCode::InvalidArgument, "at least 40 bits are expected"));
    EXPECT_FALSE(std::filesystem::exists(folder()));
    auto study = make();
    const auto head = study.ledgerHead();
    EXPECT_THAT(study.changePassphrase(weak), test::refused(ErrorCode::InvalidArgument, "bits of guessing"));
    EXPECT_EQ(study.ledgerHead(), head);
}

TEST_F(Desk, AfterAChangeTheNewPassphraseAloneOpensEverything) {
    RecordProperty("hazard", "H11");
    auto study = make();
    const auto code = enrolled(study);
    const auto before = everythingBelow(study.keyFile().parent_path());
    ASSERT_TRUE(study.changePassphrase(test::somePassphrase(kNextWords)));
    EXPECT_NE(everythingBelow(study.keyFile().parent_path()), before);
    ASSERT_TRUE(study.enrol({})) << "it goes on at once";
    { const auto closed = std::move(study); }
    EXPECT_EQ(open(Study::Access::Read).error().code, ErrorCode::NotFound);
    auto again = test::accepted(open(Study::Access::Change, kNextWords));
    EXPECT_TRUE(again.find(code));
    EXPECT_EQ(again.participants().size(), 2U);
    EXPECT_EQ(std::filesystem::status(again.keyFile()).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST_F(Desk, AChangeThatCannotBeWrittenLeavesTheOldPassphrase) {
    RecordProperty("hazard", "H8");
    if (::geteuid() == 0) {
        auto study = make();
        auto draft = study.keyFile();
        std::filesystem::create_directories((draft += ".new") / "in-the-way");  // no file takes its place
        EXPECT_EQ(study.changePassphrase(test::somePassphrase(kNextWords)).error().code, ErrorCode::Io);
        std::filesystem::remove_all(draft);
        EXPECT_TRUE(study.enrol({}));
    } else {
        static_cast<void>(make());
    }
    EXPECT_TRUE(open());
    EXPECT_FALSE(open(Study::Access::Read, kNextWords));
}

TEST_F(Desk, Kill9WhileThePassphraseChangesLeavesTheOldOrTheNew) {
    RecordProperty("hazard", "H8");
    std::mt19937 random(19);
    std::string code;
    {
        auto study = make();
        code = enrolled(study);
    }
    std::string_view opens = test::kPassphraseText;
    for (int round = 0; round < 12; ++round) {
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            auto study = open(Study::Access::Change, opens);
            if (!study) ::_exit(1);
            for (int i = 0;; ++i) {
                if (!study->changePassphrase(test::somePassphrase(i % 2 == 0 ? kNextWords : test::kPassphraseText)))
                    ::_exit(2);
                if (::write(ends[1], "c", 1) != 1) ::_exit(3);
            }
        }
        ::close(ends[1]);
        char said = 0;
        for (auto left = 1 + random() % 9; left > 0 && ::read(ends[0], &said, 1) == 1;) --left;
        ::usleep(static_cast<useconds_t>(random() % 3000));
        ASSERT_EQ(::kill(child, SIGKILL), 0);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ::close(ends[0]);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself with " << WEXITSTATUS(status);
        const bool isOld = open(Study::Access::Read).has_value();
        const bool isNew = open(Study::Access::Read, kNextWords).has_value();
        ASSERT_NE(isOld, isNew);
        opens = isOld ? test::kPassphraseText : kNextWords;
        EXPECT_TRUE(test::accepted(open(Study::Access::Change, opens)).find(code));
    }
}

}  // namespace
}  // namespace tacto
