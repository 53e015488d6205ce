#include "app/scripting/host/report/FingertipItems.h"

#include <fmt/format.h>
#include <string>

#include "app/scripting/host/plot/CalibrationFigure.h"
#include "app/scripting/host/report/Cells.h"

namespace tacto::host::report {

namespace {

Json paragraph(std::string text) { return {{"kind", "text"}, {"text", std::move(text)}}; }

Json tableItem(std::string caption, Json rows, Json columns) {
    return {
        {"kind", "table"}, {"caption", std::move(caption)}, {"rows", std::move(rows)}, {"columns", std::move(columns)}};
}

void addForce(Json& items, const Json& force) {
    if (std::isnan(numberOr(force, "scale"))) {
        items.push_back(paragraph("Force: " + textOr(force, "reason") + "."));
        return;
    }
    const auto unit = textOr(force, "unit");
    if (unit == "N") {
        Json shown = force;
        shown["quantity"] = "force";
        shown["offset"] = force.at("offset_reading");
        items.push_back({{"kind", "figure"},
                         {"caption", "Force against weights"},
                         {"figure", plot::calibrationFigure(shown, "measured")}});
    }
    Json rows = Json::array(), columns{"weight_n", "n"};
    const std::string inUnit = unit == "N" ? "_n" : "";  // counts have none
    for (const char* key : {"mean", "mean_up", "mean_down", "s", "residual"}) columns.push_back(key + inUnit);
    for (const auto& level : listIn(force, "levels")) {
        Json row = Json::object();
        copy(row, "weight_n", level, "commanded");
        copy(row, "n", level, "n");
        for (const char* key : {"mean", "mean_up", "mean_down", "s", "residual"})
            copy(row, (key + inUnit).c_str(), level, key);
        rows.push_back(std::move(row));
    }
    items.push_back(tableItem("Force against weights (reading in " + unit + ")", std::move(rows), std::move(columns)));
    const auto digits = [&force](const char* key, int count) { return digitsOf(numberOr(force, key), count); };
    items.push_back(paragraph(fmt::format(
        "Force: {} ± {} N per {}, offset {} ± {} N (95 %); hysteresis {} % and repeatability {} % of the "
        "largest weight.",
        digits("scale", 5), digits("scale_expanded_uncertainty", 2), unit, digits("offset", 3),
        digits("offset_expanded_uncertainty", 2), digits("hysteresis_pct_fs", 2), digits("repeatability_pct_fs", 2))));
}

void addTaxels(Json& items, const Json& taxels, const FingertipReferences& known) {
    if (taxels.empty()) return;
    const auto unit = textOr(taxels.front(), "unit");
    Json rows = Json::array();
    for (const auto& taxel : taxels) {
        Json row = Json::object();
        copy(row, "taxel", taxel, "taxel");
        copy(row, "scale", taxel, "scale");
        copy(row, "scale U", taxel, "scale_expanded_uncertainty");
        copy(row, "offset_pa", taxel, "offset_pa");
        copy(row, "U_pa", taxel, "offset_expanded_uncertainty_pa");
        copy(row, "residual_max_pct_fs", taxel, "residual_max_pct_fs");
        copy(row, "remark", taxel, "reason");
        rows.push_back(std::move(row));
    }
    const auto caption = known.area_cm2 > 0
                             ? fmt::format("Taxels against force over the contact area of {} cm² (scale in Pa per {})",
                                           known.area_cm2, unit.empty() ? "unit" : unit)
                             : std::string("Taxels");
    items.push_back(tableItem(caption, std::move(rows),
                              {"taxel", "scale", "scale U", "offset_pa", "U_pa", "residual_max_pct_fs", "remark"}));
    const auto toleranceOf = [](double percent) {
        return percent > 0 ? fmt::format("± {} %", percent) : std::string("not known");
    };
    items.push_back(paragraph(fmt::format(
        "A taxel's scale takes the weight as spread evenly over the contact area; it holds for a contact of that "
        "shape. Its U holds the tolerances of the weights (± {} %), of local gravity ({}) and of the contact area "
        "({}); where one is not known there is no U.",
        known.weight_pct, toleranceOf(known.gravity_pct), toleranceOf(known.area_pct))));
}

std::string rankText(const Json& rank) {
    if (!rank.is_object())
        return "Spearman's rank correlation of R against Ra: not evaluated; five or more surfaces of known Ra are "
               "wanted.";
    const auto digits = [&rank](const char* key) { return digitsOf(numberOr(rank, key), 3); };
    const auto note = textOr(rank, "note");
    return fmt::format("Spearman's rank correlation of R against Ra over {} surfaces: {} (95 %: {} to {}){}.{}",
                       numberOr(rank, "n"), digits("value"), digits("low"), digits("high"),
                       rank.value("ties", Json()) == Json(true) ? ", equal values sharing their ranks" : "",
                       note.empty() ? "" : " Note: " + note + ".");
}

std::string uncertaintyText(const Json& u) {
    if (!u.is_object()) return "The uncertainty of R was not evaluated.";
    const auto digits = [&u](const char* key, int count) { return digitsOf(numberOr(u, key), count); };
    return fmt::format(
        "U of R for one slide (95 %, k = {}): {} at R 0, {} at R 0.5, {} at R 1, from the repeatability "
        "of the slides (s = {}) and of the two references' means.",
        digits("coverage_factor", 3), digits("smooth", 2), digits("middle", 2), digits("rough", 2),
        digits("slide_sd", 2));
}

}  // namespace

Json fingertipScaleItems(const Json& scales, const FingertipReferences& known) {
    Json items = Json::array();
    addForce(items, scales.at("force"));
    addTaxels(items, listIn(scales, "taxels"), known);
    return items;
}

Json sensorCalibrationItems(const Json& found, bool simulated) {
    Json items = Json::array(
        {tableItem("Surfaces, under the scale that was found", listIn(found, "surfaces"),
                   {"name", "ra_um", "rz_um", "slides", "h", "v", "R", "R_sd", "R_expanded_uncertainty", "force_n"})});
    const Json& distances = found.at("d_prime");
    Json rows = Json::array();
    const auto add = [&rows](const std::string& of, const Json& distance) {
        if (!distance.is_object()) return;
        Json row = distance;
        row["of"] = of;
        rows.push_back(std::move(row));
    };
    for (const char* key : {"h", "h_abs", "v_static", "v_dynamic"})
        add(std::string("log10 ") + key, distances.at("all").value(key, Json()));
    add("R", distances.value("R", Json()));
    items.push_back(tableItem("Distance of the two references, in d′ with its 95 % interval", std::move(rows),
                              {"of", "value", "low", "high", "told_apart"}));
    items.push_back(paragraph(
        "d′ is the difference of the means over the pooled standard deviation of single slides; the interval is from "
        "the non-central t distribution. Two surfaces are told apart when its lower end is at least 1, the customary "
        "threshold at which one slide over each names the rougher in 76 % of cases; otherwise the calibration is "
        "refused."));
    const Json rank = found.value("spearman", Json());
    items.push_back(paragraph(rankText(rank)));
    if (rank.is_object() && simulated)
        items.push_back(
            paragraph("On the simulated fingertip the ranking holds by construction: the relief of its "
                      "surfaces follows their Ra."));
    items.push_back(paragraph(textOr(found, "known_limit")));
    items.push_back(paragraph(uncertaintyText(found.value("uncertainty_R", Json()))));
    for (const auto& warning : listIn(found, "warnings"))
        items.push_back(paragraph("Note: " + warning.get<std::string>() + "."));
    return items;
}

Json fingertipRestItems(const Json& rest, bool hasTaxels) {
    Json items = Json::array();
    if (hasTaxels) {
        Json rows = Json::array();
        for (const auto& baseline : listIn(rest, "taxel_baseline"))
            rows.push_back({{"taxel", rows.size() + 1}, {"baseline", baseline}, {"floor", rest.at("taxel_floor")}});
        items.push_back(tableItem("Taxels at rest, nothing touched (" + textOr(rest, "taxel_unit") + ")",
                                  std::move(rows), {"taxel", "baseline", "floor"}));
    }
    if (const double square = numberOr(rest, "mean_square"); !std::isnan(square)) {
        items.push_back(paragraph(fmt::format("Acceleration at rest, 5 Hz to 1 kHz: mean square {} ({})².",
                                              digitsOf(square, 3), textOr(rest, "unit"))));
    }
    return items;
}

Json fingertipTables(const Json& results) {
    Json tables = Json::array();
    if (results.contains("weights"))
        tables.push_back(
            tableItem("Weights", results.at("weights"), {"mass_g", "reference_n", "force", "direction", "repeat"}));
    if (results.contains("slides")) tables.push_back(slidesTable(results.at("slides")));
    return tables;
}

Json slidesTable(const Json& slides) {
    return tableItem("Slides", slides,
                     {"material", "h", "h_abs", "v_static", "v_dynamic", "force_n", "sliding_frames"});
}

}  // namespace tacto::host::report
