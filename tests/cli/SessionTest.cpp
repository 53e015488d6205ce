// report and verify, for sessions that this program recorded.
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "core/base/Result.h"
#include "core/session/SessionSignature.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Session : public testing::Test {
protected:
    void SetUp() override {
        const auto ran = desk.run(
            {"run", "separability", "--device", "sim:", "--set", "repeats=2", "--out", desk.at("out"), "--json"});
        ASSERT_EQ(ran.code, 5) << ran.err;
        session = jsonOf(ran)["session"];
    }
    /// Returns the session with one byte changed at `place`.
    std::string flipped(std::size_t place) const {
        auto content = contentOf(session);
        content.at(place) = static_cast<char>(content.at(place) ^ 0x04);
        return desk.write("altered.tacto", content);
    }
    const Desk desk;
    std::string session;
};

TEST_F(Session, IsIntactAfterTheRun) {
    const auto ran = desk.run({"verify", session, "--json"});
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_EQ(ran.err, "");
    const auto value = jsonOf(ran);
    EXPECT_EQ(value["status"], "intact");
    EXPECT_EQ(value["recovered"], false);
    EXPECT_EQ(value["trials"], 8);
    EXPECT_EQ(value["captures"], 16);
    EXPECT_THAT(desk.run({"verify", session}).out, HasSubstr(value["head"].get<std::string>()));
}

TEST_F(Session, AReportThatWasChangedAfterItWasSignedExitsOne) {
    RecordProperty("hazard", "H8");
    const auto report = desk.at("out") + "/signed.pdf";
    ASSERT_EQ(desk.run({"report", session, "--out", report}).code, 0);
    ASSERT_TRUE(signReport(session, report, "R. Viewer"));
    const auto verified = [&] { return desk.run({"verify", session, "--json"}); };
    EXPECT_EQ(verified().code, 0);
    const auto signature = jsonOf(verified())["signatures"].at(0);
    EXPECT_EQ(signature["by"], "R. Viewer");
    EXPECT_EQ(signature["report"], "signed.pdf");
    EXPECT_EQ(signature["state"], "unchanged");
    std::ofstream(report, std::ios::app) << ' ';
    EXPECT_EQ(verified().code, 1);
    EXPECT_EQ(jsonOf(verified())["status"], "intact") << "the recording is";
    EXPECT_EQ(jsonOf(verified())["signatures"].at(0)["state"], "changed");
    EXPECT_THAT(desk.run({"verify", session}).out, HasSubstr("it was changed after that"));
}

TEST_F(Session, AChangedByteAnywhereIsDamageAndExitsOne) {
    RecordProperty("hazard", "H8");
    const auto content = contentOf(session);
    // A trial's condition, a word of the verdict's reason, a byte in the middle of the samples.
    for (const auto place : {content.find("rough-high", content.size() / 2), content.rfind("rough-high"),
                             content.find("trials cannot show"), content.size() / 2, content.size() / 4}) {
        ASSERT_LT(place, content.size());
        const auto ran = desk.run({"verify", flipped(place), "--json"});
        EXPECT_EQ(ran.code, 1) << "byte " << place << " of " << content.size() << ": " << ran.out << ran.err;
        EXPECT_EQ(jsonOf(ran)["status"], "damaged");
        EXPECT_GE(jsonOf(ran)["problems"].size(), 1U);
    }
}

TEST_F(Session, TheReportOfAnAlteredOneSaysSoAndExitsOne) {
    RecordProperty("hazard", "H8");
    const auto content = contentOf(session);
    const auto altered = flipped(content.find("rough-high", content.size() / 2));
    for (const auto* name : {"altered.html", "altered.pdf"}) {
        const auto ran = desk.run({"report", altered, "--out", desk.at(name)});
        EXPECT_EQ(ran.code, 1) << name << ran.err;
        EXPECT_THAT(ran.err, HasSubstr("DAMAGED"));
        EXPECT_TRUE(std::filesystem::exists(desk.at(name)));
    }
    EXPECT_THAT(contentOf(desk.at("altered.html")), HasSubstr("DAMAGED"));
    EXPECT_EQ(desk.run({"report", session, "--out", desk.at("intact.html")}).code, 0);
    EXPECT_THAT(contentOf(desk.at("intact.html")), testing::Not(HasSubstr("DAMAGED")));
}

TEST_F(Session, CutShortIsDamaged) {
    RecordProperty("hazard", "H8");
    const auto cut = desk.write("cut.tacto", contentOf(session).substr(0, std::filesystem::file_size(session) / 2));
    EXPECT_EQ(desk.run({"verify", cut}).code, 1);
    const auto report = desk.run({"report", cut, "--out", desk.at("cut.pdf")});
    EXPECT_NE(report.code, 0);
    expectRefused(report, 3, {"cut.tacto"});
    EXPECT_FALSE(std::filesystem::exists(desk.at("cut.pdf")));
}

TEST_F(Session, VerifyingChangesNothing) {
    const auto before = desk.files();
    EXPECT_EQ(desk.run({"verify", session}).code, 0);
    EXPECT_EQ(desk.run({"verify", flipped(contentOf(session).find("trials cannot show"))}).code, 1);
    std::filesystem::remove(desk.at("altered.tacto"));
    EXPECT_EQ(desk.files(), before);
}

TEST_F(Session, IsComparedWithAnotherAsTextAndAsJson) {
    const auto ran = desk.run({"run", "separability", "--device", "sim:stimulator?gain=1.05", "--device",
                               "sim:", "--set", "repeats=3", "--seed", "2", "--out", desk.at("out"), "--json"});
    const std::string other = jsonOf(ran)["session"];
    const auto compared = jsonOf(desk.run({"compare", session, other, "--json"}));
    ASSERT_FALSE(compared["settings"].empty());
    const auto& first = compared["quantities"][0];
    EXPECT_EQ(first["more_than_u"], true) << "a gain of 5 % is more than the oscilloscope's uncertainty";
    double amplitude_v = 0;
    for (const auto& quantity : compared["quantities"]) {
        if (quantity["name"] != "Rough-high: Amplitude") continue;
        amplitude_v = quantity["difference"];
        EXPECT_EQ(quantity["unit"], "V");
        EXPECT_NEAR(amplitude_v / quantity["a"].get<double>(), 0.05, 0.015);
    }
    EXPECT_NE(amplitude_v, 0);
    const auto text = desk.run({"compare", session, other});
    EXPECT_EQ(text.code, 0) << text.err;
    for (const auto* part : {"Repeats", "gain=1.05", "More than U", "Rough-high: Amplitude"})
        EXPECT_THAT(text.out, HasSubstr(part));
    const auto same = jsonOf(desk.run({"compare", session, session, "--json"}));
    EXPECT_TRUE(same["settings"].empty());
    for (const auto& quantity : same["quantities"]) EXPECT_EQ(quantity["more_than_u"], false) << quantity;
    expectRefused(desk.run({"compare", session}), 2, {"two sessions"});
    expectRefused(desk.run({"compare", session, desk.at("none.tacto")}), 3, {"none.tacto"});
}

TEST_F(Session, ReportsAsPdfAndAsHtmlFromTheSessionAlone) {
    const auto alone = desk.write("alone.tacto", contentOf(session));
    std::filesystem::remove_all(desk.at("out"));
    const auto pdf = desk.run({"report", alone, "--out", desk.at("r.pdf")});
    EXPECT_EQ(pdf.code, 0) << pdf.err;
    const auto content = contentOf(desk.at("r.pdf"));
    EXPECT_TRUE(content.starts_with("%PDF-"));
    EXPECT_THAT(content.substr(content.size() - 16), HasSubstr("%%EOF"));
    EXPECT_GT(content.size(), 20000U);

    const auto html = desk.run({"report", alone, "--out", desk.at("r.html")});
    EXPECT_EQ(html.code, 0) << html.err;
    const auto page = contentOf(desk.at("r.html"));
    EXPECT_THAT(page, HasSubstr("<html"));
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("simulated"));
    EXPECT_THAT(page, HasSubstr("ndeterminate"));
    for (const auto& condition : kConditions) EXPECT_THAT(page, HasSubstr(condition));
    const auto head = jsonOf(desk.run({"verify", alone, "--json"}))["head"].get<std::string>();
    EXPECT_THAT(page, HasSubstr(head)) << "the head of the hash chain is printed in the report";
}

TEST_F(Session, AReportNeedsAnEndingThatIsKnownAndAPlace) {
    expectRefused(desk.run({"report", session}), 2, {"--out"});
    expectRefused(desk.run({"report", session, "--out", desk.at("r.docx")}), 2, {"r.docx", ".pdf", ".html"});
    expectRefused(desk.run({"report", session, "--out", desk.at("no/such/r.pdf")}), 3, {"r.pdf"});
    EXPECT_FALSE(std::filesystem::exists(desk.at("r.docx")));
}

TEST(NotASession, ExitsThreeWithOneSentence) {
    const Desk desk;
    const auto text = desk.write("notes.tacto", "These are notes, and no session of any kind.\n");
    const auto empty = desk.write("empty.tacto", "");
    for (const auto& file : {text, empty, desk.at("none.tacto"), desk.path().string()}) {
        expectRefused(desk.run({"verify", file}), 3, {file});
        expectRefused(desk.run({"verify", file, "--json"}), 3, {file});
        expectRefused(desk.run({"report", file, "--out", desk.at("r.pdf")}), 3, {file});
    }
    EXPECT_EQ(contentOf(text), "These are notes, and no session of any kind.\n");
    EXPECT_EQ(desk.files().size(), 2U);
}

TEST_F(Session, WhereTheProgramThatDrawsReportsIsMissingThatIsSaid) {
    const auto program = desk.at("tactoscope-cli");
    std::filesystem::copy_file(TACTO_CLI, program);
    std::filesystem::copy_file(std::filesystem::path(TACTO_CLI).parent_path() / "tactoscope-script",
                               desk.at("tactoscope-script"));
    const auto said = desk.at("said");
    const auto alone = program + " report '" + session + "' --out '" + desk.at("r.pdf") + "' 2>'" + said + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(alone.c_str())), 3);
    EXPECT_THAT(contentOf(said),
                HasSubstr(desk.at("tactoscope-report") + " does not start (No such file or directory)"));
    EXPECT_FALSE(std::filesystem::exists(desk.at("r.pdf")));
    const auto own = "HOME='" + desk.path().string() + "' XDG_DATA_HOME='" + desk.at("data") +
                     "' TACTOSCOPE_RESOURCES='" + (sourceDir() / "resources").string() + "' ";
    const auto run = own + program + " run variation --set participants=20 --report pdf --json --out '" +
                     desk.at("ran") + "' >'" + desk.at("value") + "' 2>'" + said + "'";
    EXPECT_NE(WEXITSTATUS(std::system(run.c_str())), 3) << contentOf(said);
    EXPECT_THAT(contentOf(said), HasSubstr("no report: " + desk.at("tactoscope-report") + " does not start"));
    EXPECT_TRUE(Json::parse(contentOf(desk.at("value")))["report"].is_null());
}

TEST_F(Session, AReportForWhichTheDiskHasNoRoomIsNoSuccessAndKeepsTheEarlierOne) {
    RecordProperty("hazard", "H8");
    for (const auto* name : {"r.pdf", "r.html"}) {
        const auto path = desk.at(name);
        ASSERT_EQ(desk.run({"report", session, "--out", path}).code, 0);
        const auto blocks = std::filesystem::file_size(path) / 512 - 1;  // all blocks except the last
        desk.write(name, "the earlier report");
        const auto said = desk.at("said");
        const auto limited = "ulimit -f " + std::to_string(blocks) + "; exec " TACTO_CLI " report '" + session +
                             "' --out '" + path + "' 2>'" + said + "'";
        EXPECT_EQ(WEXITSTATUS(std::system(limited.c_str())), 3) << contentOf(said);
        EXPECT_THAT(contentOf(said), HasSubstr("File too large"));
        EXPECT_EQ(contentOf(path), "the earlier report");
    }
}

}  // namespace
}  // namespace tacto::test
