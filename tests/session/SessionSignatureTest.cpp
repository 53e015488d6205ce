// Signatures of reports: kept in the session without a change to the recording, and compared with the report by a hash
// that the system's sha256sum computes too.
#include <cstdio>
#include <gmock/gmock.h>
#include <random>

#include "core/session/SessionLabels.h"
#include "core/session/SessionSignature.h"
#include "tests/session/SessionSupport.h"

namespace tacto {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Signatures : public testing::Test {
protected:
    Signatures() {
        RecordProperty("hazard", "H8");
        test::writeSession(path);
    }
    void write(const std::filesystem::path& file, const std::string& bytes) const {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    }
    [[nodiscard]] std::string randomBytes(std::size_t n) {
        std::string bytes(n, ' ');
        for (auto& each : bytes) each = static_cast<char>(random() & 255U);
        return bytes;
    }
    [[nodiscard]] std::vector<SignedReport> states() const {
        std::vector<SignedReport> all;
        const auto verified = verifySession(path);
        for (const auto& each : verified->signatures) all.push_back(each.state);
        return all;
    }
    [[nodiscard]] static std::string sha256sum(const std::filesystem::path& file) {
        auto* pipe = ::popen(("sha256sum '" + file.string() + "'").c_str(), "r");
        char digits[65] = "";
        EXPECT_EQ(std::fscanf(pipe, "%64s", digits), 1);
        ::pclose(pipe);
        return digits;
    }
    std::mt19937 random{49};
    test::ScratchDir dir;
    std::filesystem::path path = dir.path() / "run.tacto";
    const std::filesystem::path report = dir.path() / "run.pdf";
};

TEST_F(Signatures, AreKeptWithTheReportsHashAndTheRecordingStaysAsItIs) {
    const auto head = SessionReader::open(path)->chainHead();
    const auto text = SessionReader::open(path)->reproducibleText().value();
    for (int trial = 0; trial < 5; ++trial) {
        write(report, randomBytes(1 + random() % 5000));
        const auto by = fmt::format("A. Lind {}", trial);
        const auto done = signReport(path, report, by);
        ASSERT_TRUE(done) << done.error().message;
        EXPECT_EQ(done->by, by);
        EXPECT_EQ(done->report, "run.pdf");
        EXPECT_EQ(done->sha256, sha256sum(report));
        EXPECT_EQ(signaturesIn(path)->back(), *done);
        const auto verified = verifySession(path);
        EXPECT_EQ(verified->status, SessionStatus::Intact) << testing::PrintToString(verified->problems);
        EXPECT_EQ(verified->head, head);
        EXPECT_FALSE(reportChanged(*verified));
        EXPECT_EQ(states().back(), SignedReport::Unchanged);
        EXPECT_THAT(verified->notes, Contains(HasSubstr(by + " signed run.pdf at ")));
        EXPECT_THAT(verified->notes, Not(Contains(HasSubstr("Operator, sample"))));
    }
    EXPECT_EQ(SessionReader::open(path)->reproducibleText().value(), text);
    EXPECT_EQ(SessionReader::open(path)->labels().value(), SessionLabels{});
}

TEST_F(Signatures, TellAnyChangeOfTheReport) {
    for (int trial = 0; trial < 9; ++trial) {
        auto bytes = randomBytes(2 + random() % 3000);
        write(report, bytes);
        ASSERT_TRUE(signReport(path, report, "B. Ott"));
        const auto at = random() % bytes.size();
        if (trial % 3 == 0)
            bytes.erase(at, 1);
        else if (trial % 3 == 1)
            bytes.insert(at, 1, 'x');
        else
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
        write(report, bytes);
        EXPECT_EQ(states().back(), SignedReport::Changed);
        const auto verified = verifySession(path);
        EXPECT_TRUE(reportChanged(*verified));
        EXPECT_EQ(verified->status, SessionStatus::Intact) << "the recording is";
        ASSERT_TRUE(signReport(path, report, "R. Viewer"));
        EXPECT_FALSE(reportChanged(*verifySession(path))) << "signed again as it is now";
        EXPECT_EQ(states()[states().size() - 2], SignedReport::SignedAgain);
    }
}

TEST_F(Signatures, FindTheReportBesideAMovedSessionAndSayIfItIsGone) {
    write(report, "pages");
    ASSERT_TRUE(signReport(path, report, "B. Ott"));
    const auto folder = dir.path() / "archive";
    std::filesystem::create_directory(folder);
    std::filesystem::rename(path, folder / "run.tacto");
    path = folder / "run.tacto";
    EXPECT_EQ(states(), std::vector{SignedReport::Missing});
    EXPECT_FALSE(reportChanged(*verifySession(path)));
    std::filesystem::rename(report, folder / "run.pdf");
    EXPECT_EQ(states(), std::vector{SignedReport::Unchanged});
}

TEST_F(Signatures, AreLabelsForNobodyAndLabelsAreNoSignatures) {
    write(report, "pages");
    ASSERT_TRUE(saveLabels(path, {}, {"A. Weber", "S-1", "", {}}));
    ASSERT_TRUE(signReport(path, report, "B. Ott"));
    ASSERT_TRUE(saveLabels(path, {"A. Weber", "S-1", "", {}}, {"A. Weber", "S-2", "", {}}));
    EXPECT_EQ(SessionReader::open(path)->labels()->sample, "S-2");
    EXPECT_EQ(signaturesIn(path)->size(), 1U);
    EXPECT_THAT(verifySession(path)->notes, Contains(HasSubstr("were changed 2 times after")));
}

TEST_F(Signatures, ThatAreForgedAreFound) {
    write(report, "pages");
    ASSERT_TRUE(signReport(path, report, "B. Ott"));
    test::forge(path, "UPDATE entries SET body=replace(body, 'B. Ott', 'C. Ott') WHERE kind='annotation'");
    EXPECT_THAT(verifySession(path)->problems, Contains(HasSubstr("was altered")));
}

TEST_F(Signatures, AreRefusedWithTheReasonAndNothingChanges) {
    write(report, "pages");
    const auto before = test::bytesOf(path);
    const auto refused = [&](const std::filesystem::path& of, const std::string& by) {
        const auto done = signReport(path, of, by);
        EXPECT_FALSE(done);
        EXPECT_EQ(test::bytesOf(path), before);
        return done ? std::string() : done.error().message;
    };
    EXPECT_THAT(refused(report, ""), HasSubstr("the name of who signs is \"\""));
    EXPECT_THAT(refused(report, "  "), HasSubstr("1 to 200 characters"));
    EXPECT_THAT(refused(report, std::string(201, 'n')), HasSubstr("1 to 200 characters"));
    EXPECT_THAT(refused(report, "A\nB"), HasSubstr("one line"));
    EXPECT_THAT(refused(dir.path() / "none.pdf", "B. Ott"), HasSubstr("none.pdf"));
    EXPECT_THAT(refused(dir.path(), "B. Ott"), HasSubstr(dir.path().filename().string()));
}

}  // namespace
}  // namespace tacto
