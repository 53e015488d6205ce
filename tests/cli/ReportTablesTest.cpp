// The tables in every shipped protocol's report, as a reader sees them: one prefix per unit in a column, and ± only
// before an uncertainty or a tolerance. Also the certificate of a calibration, from the command line.
#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/cli/RunCli.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string withoutTags(std::string html) {
    html = std::regex_replace(html, std::regex("<br/>|<small>"), " ");
    html = std::regex_replace(html, std::regex("<[^>]*>"), "");
    for (const auto& [from, to] : {std::pair("&lt;", "<"),
                                   {"&gt;", ">"},
                                   {"&amp;", "&"},
                                   {"\u202f", " "},
                                   {"\u00a0", " "},
                                   {"\u2007", ""},
                                   {"\u2008", ""}})
        html = std::regex_replace(html, std::regex(from), to);
    return html;
}

struct Table {
    std::string caption;
    std::vector<std::vector<std::string>> rows;  ///< the header comes first
};

std::vector<Table> tablesOf(const std::string& html) {
    std::vector<Table> tables;
    for (auto at = html.find("<table"); at != html.npos; at = html.find("<table", at + 1)) {
        const auto text = html.substr(at, html.find("</table>", at) - at);
        Table table;
        if (const auto caption = text.find("<caption>"); caption != text.npos)
            table.caption = withoutTags(text.substr(caption, text.find("</caption>") - caption));
        for (auto row = text.find("<tr>"); row != text.npos; row = text.find("<tr>", row + 1)) {
            table.rows.emplace_back();
            auto end = text.find("</tr>", row);
            for (auto cell = row; (cell = std::min(text.find("<td", cell + 1), text.find("<th", cell + 1))) < end;) {
                const auto close = std::min(text.find("</td>", cell), text.find("</th>", cell));
                table.rows.back().push_back(withoutTags(text.substr(cell, close - cell)));
            }
        }
        tables.push_back(std::move(table));
    }
    return tables;
}

/// Adds the prefixes of units in the figures of one cell, by unit without prefix; a cell with words has none.
void addUnits(const std::string& cell, std::map<std::string, std::set<std::string>>& met) {
    static const std::regex kUnit("[0-9] ([pnµmkMG]?)(V|A|s|Ω|C|J|W|Hz|Pa|N|F)((?:/cm²)?)(?![A-Za-zµΩ])");
    static const std::regex kWords("[A-Za-z]{3,}|∥|\\+");
    if (std::regex_search(std::regex_replace(cell, std::regex("s\\.d\\.|unknown|not judged"), ""), kWords)) return;
    for (std::sregex_iterator each(cell.begin(), cell.end(), kUnit), end; each != end; ++each)
        met[(*each)[2].str() + (*each)[3].str()].insert((*each)[1]);
}

void expectOnePrefix(const std::string& html, const std::string& protocol) {
    const auto tables = tablesOf(html);
    EXPECT_GE(tables.size(), 1U) << protocol;
    for (const auto& table : tables) {
        if (table.rows.empty()) continue;
        EXPECT_THAT(table.caption, Not(HasSubstr("± s.d."))) << protocol;
        for (std::size_t column = 0; column < table.rows.front().size(); ++column) {
            const auto& header = table.rows.front()[column];
            EXPECT_FALSE(header.find("±") != header.npos && header.find("s.d.") != header.npos) << header;
            if (header == "Load" || header == "Accuracy") continue;  // these columns contain names or sentences
            std::map<std::string, std::set<std::string>> met;
            for (std::size_t row = 1; row < table.rows.size(); ++row) {
                if (column < table.rows[row].size()) addUnits(table.rows[row][column], met);
            }
            for (const auto& [unit, prefixes] : met) {
                EXPECT_EQ(prefixes.size(), 1U)
                    << protocol << ": " << table.caption << ", column \"" << header << "\" mixes prefixes of " << unit;
            }
        }
    }
}

/// Settings with fewer trials than usual, by protocol.
const std::map<std::string, Words> kSettings{{"separability", {"repeats=2"}},
                                             {"transitions", {"repeats=1"}},
                                             {"variation", {"participants=20", "trials=5"}},
                                             {"encoding-comparison", {"repeats=2", "level_repeats=2"}},
                                             {"live", {"duration=5"}},
                                             {"massager", {"duration=5"}},
                                             {"load-safety", {"steps=2", "area=1"}},
                                             {"sensor-calibration", {"more=", "slides=3"}},
                                             {"stimulator-calibration", {"levels=4", "repeats=2"}}};

/// Returns the shipped protocols that need no participant.
std::vector<std::string> shippedProtocols() {
    std::vector<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(sourceDir() / "resources" / "protocols")) {
        if (const auto name = file.path().stem().string(); !name.starts_with("pilot-")) names.push_back(name);
    }
    return names;
}

class ReportTables : public testing::TestWithParam<std::string> {};

TEST_P(ReportTables, HaveOnePrefixInAColumnAndNoDeviationAfterPlusMinus) {
    RecordProperty("hazard", "H8");
    const auto& protocol = GetParam();
    const Desk desk;
    Words words{"run", protocol, "--device", "sim:", "--seed", "7", "--report", "html", "--out", desk.at("out")};
    if (const auto settings = kSettings.find(protocol); settings != kSettings.end()) {
        for (const auto& setting : settings->second) {
            words.emplace_back("--set");
            words.push_back(setting);
        }
    }
    const auto ran = desk.run(words);
    ASSERT_TRUE(ran.code == 0 || ran.code == 1 || ran.code == 5) << ran.err;
    expectOnePrefix(contentOf(desk.named("out", ".html").at(0)), protocol);
}

INSTANTIATE_TEST_SUITE_P(OfEveryShippedProtocol, ReportTables, testing::ValuesIn(shippedProtocols()),
                         [](const auto& tested) {
                             auto name = tested.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

class CertificateOfARun : public testing::Test {
protected:
    [[nodiscard]] Ran calibrate(const Words& more, std::string_view out = "out") const {
        Words words{"run",      "stimulator-calibration",
                    "--device", "sim:",
                    "--set",    "quantities=amplitude",
                    "--set",    "levels=3",
                    "--set",    "repeats=2",
                    "--out",    desk.at(out)};
        words.insert(words.end(), more.begin(), more.end());
        return desk.run(words);
    }
    [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(desk.path() / name) << text;
        return (desk.path() / name).string();
    }
    Desk desk;
};

TEST_F(CertificateOfARun, TakesItsWordsFromWhatIsKeptAndFromTheOrder) {
    RecordProperty("hazard", "H8");
    for (const auto& line : desk.environment()) {
        if (!line.starts_with("XDG_DATA_HOME=")) continue;
        const std::filesystem::path home(line.substr(14) + "/tactoscope");
        std::filesystem::create_directories(home);
        std::ofstream(home / "certificate-details.json") << R"({"laboratory": "Lab Nord", "address": "Street 1"})";
    }
    const auto order = file("order.json", R"({"customer": "Institut <T>", "address": "Street 2", "make": "Hasomed"})");
    const auto ran =
        calibrate({"--certificate-details", order, "--ambient", "22.5 °C, 45 % RH", "--operator", "A. W."});
    EXPECT_EQ(ran.code, 5) << ran.err;  // three levels are fewer than required
    const auto html = contentOf(desk.named("out", ".html").at(0));
    for (const char* wanted : {"<h1>Calibration certificate – SIMULATED</h1>", "<dt>Laboratory</dt><dd>Lab Nord</dd>",
                               "<dt>Address</dt><dd>Street 2</dd>", "<dt>Customer</dt><dd>Institut &lt;T&gt;</dd>",
                               "<dt>Make</dt><dd>Hasomed</dd>", "<dt>Contact</dt><dd class=\"blank\"></dd>",
                               "<dt>Received on</dt><dd class=\"blank\"></dd>",
                               "The results relate only to the items calibrated.", "Interval was not calibrated",
                               "as left is as found", "not traceable: SIMULATED", "End of calibration certificate"})
        EXPECT_THAT(html, HasSubstr(wanted));
    // The session has the same data, so its report can be made again later.
    const auto again = desk.run({"report", desk.named("out", ".tacto").at(0), "--out", desk.at("again.html")});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(contentOf(desk.at("again.html")), HasSubstr("Institut &lt;T&gt;"));
}

TEST_F(CertificateOfARun, RefusesDetailsInOneSentenceBeforeAnythingIsOpened) {
    expectRefused(desk.run({"run", "separability", "--device", "sim:", "--certificate-details", file("a.json", "{}")}),
                  2, {"--certificate-details", "separability", "a stimulator calibration is expected"});
    expectRefused(calibrate({"--certificate-details", desk.at("none.json")}, "no"), 3, {"none.json"});
    expectRefused(calibrate({"--certificate-details", file("b.json", R"({"costumer": "C"})")}, "no"), 3,
                  {"b.json", "\"costumer\" is unknown", "customer"});
    expectRefused(calibrate({"--certificate-details", file("c.json", R"({"received": "2999-01-01"})")}, "no"), 3,
                  {"received", "2999-01-01"});
    EXPECT_TRUE(desk.named("no", "").empty());
}

}  // namespace
}  // namespace tacto::test
