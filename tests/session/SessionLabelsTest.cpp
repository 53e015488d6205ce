// Labels entered after a session ended: saved without a change to the recording, or refused with a reason.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <random>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/session/SessionLabels.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Labels : public testing::Test {
protected:
    Labels() {
        RecordProperty("hazard", "H8");
        test::writeSession(path);
    }
    [[nodiscard]] SessionLabels kept() const { return SessionReader::open(path)->labels().value(); }
    [[nodiscard]] std::string refusal(const SessionLabels& wanted) const {
        const auto before = test::bytesOf(path);
        const auto saved = saveLabels(path, {}, wanted);
        EXPECT_FALSE(saved);
        EXPECT_EQ(test::bytesOf(path), before) << "the session is as it was";
        EXPECT_EQ(filesBeside(), 1) << "and nothing stays beside it";
        return saved ? std::string() : saved.error().message;
    }
    [[nodiscard]] std::ptrdiff_t filesBeside() const {
        return std::distance(std::filesystem::directory_iterator(dir.path()), std::filesystem::directory_iterator());
    }
    test::ScratchDir dir;
    std::filesystem::path path = dir.path() / "run.tacto";
    SessionLabels labels{"A. Weber", "S-014", "table bumped once", {"P60", "P120"}};
};

TEST_F(Labels, AreKeptBehindTheEndAndTheRecordingStaysAsItIs) {
    const auto before = SessionReader::open(path);
    const auto text = before->reproducibleText().value();
    ASSERT_TRUE(saveLabels(path, {}, labels));
    EXPECT_EQ(kept(), labels);
    EXPECT_EQ(filesBeside(), 1);
    const auto after = SessionReader::open(path);
    EXPECT_TRUE(after->closed());
    EXPECT_EQ(after->chainHead(), before->chainHead()) << "the head that the report prints";
    EXPECT_EQ(after->reproducibleText().value(), text);
    EXPECT_EQ(after->lastAt(), before->lastAt());
    const auto verified = verifySession(path);
    EXPECT_EQ(verified->status, SessionStatus::Intact) << testing::PrintToString(verified->problems);
    EXPECT_EQ(verified->head, before->chainHead());
    EXPECT_THAT(verified->notes, Contains(HasSubstr("were changed 1 time after")));
}

TEST_F(Labels, AreKeptInASessionOfEveryName) {
    std::mt19937 random(20261129);
    for (std::size_t length : {7U, 100U, 240U, 244U, 248U, 251U, 252U, 254U, 255U}) {
        std::string name;
        while (name.size() + 6 < length) name += static_cast<char>(random() % 3 == 0 ? 0x80 + random() % 128 : 'a');
        const auto named = dir.path() / (name + ".tacto");
        std::filesystem::rename(path, named);
        path = named;
        labels.note = std::string(length, 'n');
        const auto saved = saveLabels(path, kept(), labels);
        ASSERT_TRUE(saved) << length << ": " << saved.error().message;
        EXPECT_EQ(kept(), labels);
        EXPECT_EQ(filesBeside(), 1);
        EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
    }
}

TEST_F(Labels, AreChangedOneByOneAndOnlyChangesAreWritten) {
    ASSERT_TRUE(saveLabels(path, {}, labels));
    const auto once = verifySession(path)->rows;
    ASSERT_TRUE(saveLabels(path, {}, labels));
    EXPECT_EQ(verifySession(path)->rows, once) << "nothing was changed";
    const auto shown = labels;
    labels.note.clear();
    ASSERT_TRUE(saveLabels(path, shown, labels));
    EXPECT_EQ(kept(), labels);
    EXPECT_EQ(verifySession(path)->rows, once + 1);
}

TEST_F(Labels, ThatWereChangedElsewhereMeanwhileStay) {
    ASSERT_TRUE(saveLabels(path, {}, labels));
    const auto shown = labels;  // what two windows show
    auto here = shown, there = shown;
    there.operatorName = "B. Ott";
    there.tags = {"repeat"};
    here.note = "lead was loose";
    ASSERT_TRUE(saveLabels(path, shown, there));
    const auto kept_here = saveLabels(path, shown, here);
    const SessionLabels both{"B. Ott", "S-014", "lead was loose", {"repeat"}};
    EXPECT_EQ(kept(), both);
    ASSERT_TRUE(kept_here);
    EXPECT_EQ(*kept_here, both) << "and the window is told what it did not know";
}

TEST_F(Labels, BeginWithWhatWasEnteredBeforeTheRun) {
    std::filesystem::remove(path);
    test::HandClock clock;
    auto writer = SessionWriter::create(path, test::someAbout(), clock).value();
    ASSERT_TRUE(writer->reportItem(clock.now(), {{"kind", "notes"}, {"operator", "B. Ott"}, {"sample", "S-1"}}));
    ASSERT_TRUE(writer->close());
    EXPECT_EQ(kept(), (SessionLabels{"B. Ott", "S-1", "", {}}));
    ASSERT_TRUE(saveLabels(path, {"B. Ott", "S-1", "", {}}, {"B. Ott", "S-2", "", {}}));
    EXPECT_EQ(kept(), (SessionLabels{"B. Ott", "S-2", "", {}}));
}

TEST_F(Labels, ThatWereForgedAreFound) {
    ASSERT_TRUE(saveLabels(path, {}, labels));
    test::forge(path, "UPDATE entries SET body=replace(body, 'S-014', 'S-015') WHERE kind='annotation'");
    EXPECT_THAT(verifySession(path)->problems, Contains(HasSubstr("was altered")));
}

TEST_F(Labels, AreTheOnlyRowsBehindTheEnd) {
    ASSERT_TRUE(saveLabels(path, {}, labels));
    test::forge(path, "UPDATE entries SET kind='event' WHERE kind='annotation'");
    EXPECT_THAT(verifySession(path)->problems, Contains(HasSubstr("comes after the end mark")));
    EXPECT_FALSE(SessionReader::open(path)->closed());
}

TEST_F(Labels, OfAReadOnlySessionAreRefusedWithTheReason) {
    std::filesystem::permissions(path, std::filesystem::perms::owner_read);
    EXPECT_THAT(refusal(labels), HasSubstr("run.tacto is read-only"));
}

TEST_F(Labels, OfALockedSessionAreRefusedWithTheReason) {
    const int other = ::open(path.c_str(), O_RDONLY);  // as another program would: each open file has locks of its own
    ASSERT_EQ(::flock(other, LOCK_EX), 0);
    EXPECT_THAT(refusal(labels), HasSubstr("run.tacto is locked"));
    ::close(other);
    EXPECT_TRUE(saveLabels(path, {}, labels));
}

TEST_F(Labels, OfASessionThatIsBeingRecordedAreRefused) {
    std::filesystem::remove(path);
    test::HandClock clock;
    auto writer = SessionWriter::create(path, test::someAbout(), clock).value();
    ASSERT_TRUE(writer->event(clock.now(), "armed", {}));
    const auto saved = saveLabels(path, {}, labels);
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().message, HasSubstr("has no end mark"));
    ASSERT_TRUE(writer->event(clock.now(), "stop", {})) << "and the recording goes on";
    ASSERT_TRUE(writer->close());
    EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
}

TEST_F(Labels, ThatDoNotFitOnTheDiskLeaveTheSessionAsItWas) {
    signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit now{std::filesystem::file_size(path) / 2, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &now), 0);
    const auto saved = saveLabels(path, {}, labels);
    setrlimit(RLIMIT_FSIZE, &before);
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().message, HasSubstr("could not be changed and is as it was"));
    EXPECT_EQ(filesBeside(), 1);
    EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
    EXPECT_EQ(kept(), SessionLabels{});
    signal(SIGXFSZ, SIG_DFL);
}

TEST_F(Labels, OfAProgramThatIsKilledAreWholeOrNotThere) {
    const auto recorded = SessionReader::open(path)->chainHead();
    std::mt19937 random(12);
    int kept = 0;
    for (int round = 0; round < 40; ++round) {
        SCOPED_TRACE(round);
        int ends[2];
        ASSERT_EQ(pipe(ends), 0);
        const pid_t child = fork();
        if (child == 0) {
            close(ends[0]);
            for (int number = kept + 1;; ++number) {
                SessionLabels changed;
                changed.note = fmt::format("note {}", number);
                if (!saveLabels(path, {}, changed) || write(ends[1], "k", 1) != 1) _exit(1);
            }
        }
        close(ends[1]);
        const auto told = static_cast<int>(random() % 3);
        char said = 0;
        for (int i = 0; i < told; ++i) ASSERT_EQ(read(ends[0], &said, 1), 1);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 8000));  // killed at a random moment
        ASSERT_EQ(kill(child, SIGKILL), 0);
        int acknowledged = kept + told;
        while (read(ends[0], &said, 1) == 1) ++acknowledged;
        close(ends[0]);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
        const auto reader = SessionReader::open(path);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_TRUE(reader->closed());
        EXPECT_EQ(reader->chainHead(), recorded);
        EXPECT_TRUE(reader->checkChain());
        EXPECT_EQ(verifySession(path)->status, SessionStatus::Intact);
        const auto note = reader->labels()->note;
        if (note == fmt::format("note {}", acknowledged + 1)) ++acknowledged;  // killed before it reported this
        EXPECT_EQ(note, acknowledged == 0 ? "" : fmt::format("note {}", acknowledged));
        kept = acknowledged;
    }
    EXPECT_GT(kept, 10);
    EXPECT_TRUE(saveLabels(path, {}, labels)) << "a program that was killed holds nothing";
}

TEST_F(Labels, ThatAreNotAcceptedAreNamedWithTheirValue) {
    EXPECT_THAT(refusal({"", "", "two\nlines", {}}), HasSubstr("the note is \"two\\x0alines\""));
    EXPECT_THAT(refusal({std::string(201, 'x'), "", "", {}}),
                HasSubstr("the operator has 201 characters; at most 200"));
    EXPECT_THAT(refusal({"", "", "", {"a", "a"}}), HasSubstr("the tag \"a\" is given twice"));
    EXPECT_THAT(refusal({"", "", "", {"a,b"}}), HasSubstr("a text without a comma"));
    EXPECT_TRUE(checkLabels({"", "", "µ Ω", {"µ"}}));
}

}  // namespace
}  // namespace tacto
