// Every refusal is one sentence that names file, line and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/acquisition/Recording.h"
#include "tests/support/Support.h"

using namespace tacto;
using tacto::test::ScratchDir;
using testing::HasSubstr;

namespace {

const std::string kGoodCsv = "time,force\n0,1\n0.01,2\n";

std::string describe(const std::string& more = "", const std::string& unit = "N", const std::string& file = "f.csv",
                     const std::string& column = "force", const std::string& kind = "force",
                     const std::string& timeUnit = "s") {
    return R"({)" + more + R"("streams": [{"kind": ")" + kind + R"(", "file": ")" + file +
           R"(", "time_column": "time", "time_unit": ")" + timeUnit + R"(", "columns": [")" + column +
           R"("], "unit": ")" + unit + R"("}]})";
}

Error refused(const std::string& csv, const std::string& json) {
    const ScratchDir folder;
    folder.write("f.csv", csv);
    folder.write("recording.json", json);
    const auto recording = Recording::open(folder.path());
    EXPECT_FALSE(recording) << "read without complaint:\n" << csv << "\n" << json;
    return recording ? Error{} : recording.error();
}

std::string complaintAbout(const std::string& csv) { return refused(csv, describe()).message; }

}  // namespace

TEST(RecordingRefusal, AFolderWithoutADescriptionIsRefusedInOneSentenceThatSaysWhereATemplateIs) {
    const ScratchDir folder;
    const auto recording = Recording::open(folder.path());
    ASSERT_FALSE(recording);
    EXPECT_EQ(recording.error().code, ErrorCode::NotFound);
    EXPECT_THAT(recording.error().message, HasSubstr("has no recording.json"));
    EXPECT_THAT(recording.error().message, HasSubstr("roughness --template"));
    EXPECT_EQ(recording.error().message.find('\n'), std::string::npos);
    // Used unchanged, the template fails only because its files are missing.
    folder.write("recording.json", recordingTemplate());
    EXPECT_THAT(Recording::open(folder.path()).error().message, HasSubstr("acceleration.csv"));
}

TEST(RecordingRefusal, NothingThere) {
    const auto recording = Recording::open("/no/such/place");
    ASSERT_FALSE(recording);
    EXPECT_EQ(recording.error().code, ErrorCode::NotFound);
    EXPECT_THAT(recording.error().message, HasSubstr("/no/such/place"));
}

TEST(RecordingRefusal, NamesFileAndLineOfACellThatIsNoNumber) {
    RecordProperty("hazard", "H10");
    EXPECT_THAT(complaintAbout("time,force\n0,1\n0.01,two\n0.02,3\n"), HasSubstr("f.csv:3: column \"force\": \"two\""));
    EXPECT_THAT(complaintAbout("time,force\n0,1\nnan,2\n0.02,3\n"), HasSubstr("f.csv:3: column \"time\""));
    EXPECT_THAT(complaintAbout("time,force\n0,1\n,2\n0.02,3\n"), HasSubstr("f.csv:3: column \"time\": an empty cell"));
    EXPECT_THAT(complaintAbout("time,force\n0,1\n0.01,\"2,5\"\n0.02,3\n"), HasSubstr("f.csv:3"));
}

TEST(RecordingRefusal, TwoHeaderLines) {
    EXPECT_THAT(complaintAbout("time,force\nwhen,what\n0,1\n0.01,2\n"),
                HasSubstr("f.csv:2: column \"time\": \"when\" where a number was expected"));
}

TEST(RecordingRefusal, EmptyHeaderOnlyAndCutShort) {
    EXPECT_THAT(complaintAbout(""), HasSubstr("f.csv:1: the file is empty"));
    EXPECT_THAT(complaintAbout("\r\n\r\n"), HasSubstr("the file is empty"));
    EXPECT_THAT(complaintAbout("time,force\n"), HasSubstr("at least 2"));
    EXPECT_THAT(complaintAbout("time,force\n0,1\n"), HasSubstr("at least 2"));
    EXPECT_THAT(complaintAbout("time,force\n0,1\n0.01,2\n0.02"), HasSubstr("f.csv:4: the row has 1 cells"));
    EXPECT_THAT(complaintAbout("time,force\n0,1\n0.01,2,9\n"), HasSubstr("f.csv:3: the row has 3 cells"));
}

TEST(RecordingRefusal, TimeThatStandsStill) {
    EXPECT_THAT(complaintAbout("time,force\n1,1\n1,2\n1,3\n"), HasSubstr("time never moves forward"));
}

TEST(RecordingRefusal, ColumnsThatAreNotThere) {
    EXPECT_THAT(complaintAbout("t,force\n0,1\n1,2\n"), HasSubstr("f.csv:1: no column \"time\" in the header"));
    EXPECT_THAT(complaintAbout("time,power\n0,1\n1,2\n"), HasSubstr("which names time, power"));
    EXPECT_THAT(complaintAbout("time,force,force\n0,1,1\n1,2,2\n"), HasSubstr("\"force\" is given twice"));
}

TEST(RecordingRefusal, UnitsKindsAndTimes) {
    EXPECT_THAT(refused(kGoodCsv, describe("", "kgf")).message,
                HasSubstr("one of N, mN, kN, count, uV, mV, V was expected"));
    EXPECT_THAT(refused(kGoodCsv, describe("", "Pa")).message, HasSubstr("for force"));
    EXPECT_THAT(refused(kGoodCsv, describe("", "N", "f.csv", "force", "pressure")).message,
                HasSubstr("acceleration, force or taxels was expected"));
    EXPECT_THAT(refused(kGoodCsv, describe("", "N", "f.csv", "force", "force", "min")).message,
                HasSubstr("s, ms, us or ns was expected"));
    EXPECT_THAT(refused(kGoodCsv, describe("", "count", "f.csv", "force", "taxels")).message,
                HasSubstr("names 1 columns; for taxels 2"));
}

TEST(RecordingRefusal, FilesOutsideTheFolder) {
    RecordProperty("hazard", "H10");
    for (const std::string file : {"/etc/passwd", "../f.csv", "sub/../../f.csv", ".."}) {
        const auto error = refused(kGoodCsv, describe("", "N", file));
        EXPECT_EQ(error.code, ErrorCode::ParseError) << file;
        EXPECT_THAT(error.message, HasSubstr("inside the recording's folder")) << file;
    }
    const ScratchDir outside;
    const ScratchDir folder;
    const auto target = outside.write("secret.csv", kGoodCsv);
    std::filesystem::create_symlink(target, folder.path() / "f.csv");
    folder.write("recording.json", describe());
    EXPECT_THAT(Recording::open(folder.path()).error().message, HasSubstr("climbs out"));
    EXPECT_THAT(refused(kGoodCsv, describe("", "N", "absent.csv")).message, HasSubstr("no such file"));
    EXPECT_THAT(refused(kGoodCsv, describe("", "N", ".")).message, HasSubstr("no such file"));
}

TEST(RecordingRefusal, Descriptions) {
    EXPECT_THAT(refused(kGoodCsv, "{ \"streams\": [").message, HasSubstr("recording.json"));
    EXPECT_THAT(refused(kGoodCsv, "").message, HasSubstr("JSON"));
    EXPECT_THAT(refused(kGoodCsv, "[1, 2]").message, HasSubstr("[1,2] stands where an object is expected"));
    EXPECT_THAT(refused(kGoodCsv, "{}").message, HasSubstr("\"streams\" is missing"));
    EXPECT_THAT(refused(kGoodCsv, R"({"streams": [3]})").message, HasSubstr("streams[0]"));
    EXPECT_THAT(refused(kGoodCsv, R"({"title": 3, "streams": [3]})").message, HasSubstr("\"title\""));
    EXPECT_THAT(refused(kGoodCsv, describe(R"("baseline": [1, 0],)")).message, HasSubstr("begin < end"));
    EXPECT_THAT(refused(kGoodCsv, describe(R"("baseline": [7, 9],)")).message, HasSubstr("lies outside the data"));
    EXPECT_THAT(refused(kGoodCsv, describe(R"("contact": [3],)")).message, HasSubstr("\"contact[0]\""));
    EXPECT_THAT(refused(kGoodCsv, describe(R"("contact": 3,)")).message, HasSubstr("\"contact\""));
}

TEST(RecordingRefusal, TwoStreamsOfOneKind) {
    const auto one = R"({"kind": "force", "file": "f.csv", "time_column": "time", "time_unit": "s",
                         "columns": ["force"], "unit": "N"})";
    const auto error = refused(kGoodCsv, std::string(R"({"streams": [)") + one + "," + one + "]}");
    EXPECT_THAT(error.message, HasSubstr("two force streams"));
}
