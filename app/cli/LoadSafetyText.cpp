#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/ResultText.h"
#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

void printLoads(const json& loads) {
    TextTable table({"load", ">measured", ">peak voltage", ">peak current", ">5 s RMS", ">charge", ">net charge",
                     ">energy", "verdict"});
    for (const auto& load : loads) {
        const auto refused = load.value("commands_refused", 0.0);
        table.add({resultText(load, "name"), resultQuantity(load, "measured_ohm", "ohm"),
                   resultQuantity(load, "peak_v", "V"), resultQuantity(load, "peak_ma", "mA"),
                   resultQuantity(load, "rms_5s_ma", "mA"), resultQuantity(load, "charge_uc", "uC"),
                   resultQuantity(load, "net_charge_uc", "uC"), resultQuantity(load, "energy_mj", "mJ"),
                   resultText(load, "verdict") +
                       (refused > 0 ? fmt::format(" ({} refused as expected)", resultNumber(load, "commands_refused"))
                                    : "")});
    }
    table.print();
}

void printDisclosed(const json& outputs) {
    if (outputs.empty()) return;
    TextTable table({"to disclose", "", ">", ""});
    for (const auto& output : outputs) {
        const auto bound = output.find("plus_minus_pct");
        table.add({resultText(output, "output"), resultText(output, "load"),
                   resultQuantity(output, "value", resultText(output, "unit")),
                   output.contains("reason") && !resultText(output, "reason").empty() ? resultText(output, "reason")
                   : bound != output.end() && bound->is_number() ? fmt::format("± {:.2g} %", bound->get<double>())
                                                                 : std::string()});
    }
    table.print();
}

/// Rows that passed are counted; any other is named.
void printRows(const json& rows, const char* heading) {
    std::size_t passed = 0;
    TextTable table({"", "", "", ""});
    for (const auto& row : rows) {
        if (resultText(row, "verdict") == "pass") {
            ++passed;
            continue;
        }
        table.add({resultText(row, "verdict"), resultText(row, "load"), resultText(row, "title"),
                   resultQuantity(row, "value", resultText(row, "unit"))});
    }
    if (passed < rows.size()) say("\n  {}\n", heading);
    table.print();
    say("\n  {}: {} of {} rows passed\n", heading, passed, rows.size());
}

}  // namespace

void printLoadSafety(const json& results) {
    printLoads(resultList(results, "loads"));
    printDisclosed(resultList(results, "disclosed"));
    printRows(resultList(results, "rows"), "limits, tolerances, refusals and trips");
    const auto worst = results.value("worst_case", json::object());
    if (worst.contains("rows")) {
        printRows(worst["rows"], fmt::format("worst case over {} to {} ohm", resultNumber(worst, "load_low_ohm"),
                                             resultNumber(worst, "load_high_ohm"))
                                     .c_str());
    }
}

}  // namespace tacto::cli
