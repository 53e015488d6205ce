// The operator's statements about the specimens: surfaces by Ra and Rz or by a profilometer's file, and weights.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/scripting/host/sensor_calibration/FingertipCalibration.h"
#include "core/analysis/sensor_calibration/ProfilometerFile.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/TypedNumber.h"

namespace tacto::host::sensor_calibration {

namespace {

/// Errors: InvalidArgument for a path that the operator did not give, or that is not a file.
Result<ProfilometerReading> readChosen(ScriptSession& session, const std::string& path) {
    // The error is the same whether the file exists or not, so that a script cannot search the disk (hazard H10).
    if (!session.isOperatorsText(path)) {
        return fail(ErrorCode::InvalidArgument,
                    "bench.profilometer: the operator did not choose {}; a path that the operator gave as a parameter "
                    "or entered is expected",
                    shown(path));
    }
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        return fail(ErrorCode::InvalidArgument, "bench.profilometer: {} is not a file that can be read", shown(path));
    }
    return readProfilometer(path);
}

Result<GivenSurface> fromFile(ScriptSession& session, std::string name, const std::string& path) {
    const auto found = readChosen(session, path);
    if (!found) return failure(found);
    return GivenSurface{std::move(name), found->ra_um, found->rz_um, path};
}

/// Returns the parts of `text` between semicolons.
std::vector<std::string> partsOf(const std::string& text) {
    std::vector<std::string> parts;
    for (const auto part : split(text, ';')) {
        if (const auto bare = trimmed(part); !bare.empty()) parts.emplace_back(bare);
    }
    return parts;
}

Result<double> positive(const std::string& text, const std::string& what) {
    const auto value = typedNumber(text);
    if (value && *value > 0 && std::isfinite(*value)) return *value;
    return fail(ErrorCode::InvalidArgument, "{} is {}; a number above 0 is expected{}", what, text, typedTrouble(text));
}

/// Reads "NAME RA RZ" in µm, or "NAME FILE.csv".
Result<GivenSurface> surfaceFrom(ScriptSession& session, const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    const bool isNumber = words.size() >= 2 && words[1][0] >= '0' && words[1][0] <= '9';
    if (words.size() == 2 && !isNumber) return fromFile(session, words[0], words[1]);
    if (words.size() < 2 || words.size() > 3) {
        return fail(ErrorCode::InvalidArgument, "more has \"{}\"; NAME RA RZ in um or NAME FILE.csv is expected", text);
    }
    GivenSurface surface{words[0]};
    const auto ra = positive(words[1], "Ra of " + words[0]);
    if (!ra) return failure(ra);
    surface.ra_um = *ra;
    if (words.size() == 2) return surface;
    const auto rz = positive(words[2], "Rz of " + words[0]);
    if (!rz) return failure(rz);
    surface.rz_um = *rz;
    return surface;
}

Result<void> checkSurfaces(const std::vector<GivenSurface>& surfaces) {
    for (const auto& surface : surfaces) {
        if (!std::isnan(surface.rz_um) && !(surface.rz_um >= surface.ra_um)) {
            return fail(ErrorCode::InvalidArgument, "Rz of {} is {} um; at least its Ra, {} um, is expected",
                        surface.name, surface.rz_um, surface.ra_um);
        }
    }
    if (const auto* second = secondIn(surfaces, &GivenSurface::name))
        return fail(ErrorCode::InvalidArgument, "{}", givenTwice("surface {}", second->name));
    if (!(surfaces[1].ra_um > surfaces[0].ra_um)) {
        return fail(ErrorCode::InvalidArgument,
                    "Ra of the rough reference is {} um; more than the smooth one's, {} um, is expected",
                    surfaces[1].ra_um, surfaces[0].ra_um);
    }
    return {};
}

}  // namespace

Result<Json> profilometer(ScriptSession& session, const Arguments& arguments) {
    const auto found = readChosen(session, arguments.text("path"));
    if (!found) return failure(found);
    return Json{{"ra_um", numberOrNull(found->ra_um)},
                {"rz_um", numberOrNull(found->rz_um)},
                {"ra_values", found->raValues},
                {"rz_values", found->rzValues}};
}

std::vector<HostParameter> surfaceSettings() {
    using namespace takes;
    return {text("settings.smooth", "the smooth reference"),
            number("settings.smooth_ra_um", "um", "its Ra").above(0),
            number("settings.smooth_rz_um", "um", "its Rz; 0: not stated").atLeast(0),
            text("settings.smooth_file", "in place of both, its profilometer CSV").orEmpty(),
            text("settings.rough", "the rough reference"),
            number("settings.rough_ra_um", "um", "its Ra").above(0),
            number("settings.rough_rz_um", "um", "its Rz; 0: not stated").atLeast(0),
            text("settings.rough_file", "in place of both, its profilometer CSV").orEmpty(),
            text("settings.more", "further surfaces: NAME RA RZ in um, or NAME FILE.csv; separated by ;").orEmpty()};
}

Result<std::vector<GivenSurface>> surfacesGiven(ScriptSession& session, const Arguments& arguments) {
    std::vector<GivenSurface> given;
    for (const std::string which : {"settings.smooth", "settings.rough"}) {
        const std::string name(trimmed(arguments.text(which))), file = arguments.text(which + "_file");
        if (file.empty()) {
            const double rz_um = arguments.number(which + "_rz_um");
            given.push_back({name, arguments.number(which + "_ra_um"), rz_um > 0 ? rz_um : kNaN});
            continue;
        }
        auto read = fromFile(session, name, file);
        if (!read) return failure(read);
        given.push_back(std::move(*read));
    }
    for (const auto& text : partsOf(arguments.text("settings.more"))) {
        auto surface = surfaceFrom(session, text);
        if (!surface) return failure(surface);
        given.push_back(std::move(*surface));
    }
    if (auto fits = checkSurfaces(given); !fits) return failure(fits);
    return given;
}

Result<std::vector<double>> massesGiven(const std::string& text) {
    std::vector<double> masses;
    for (const auto& part : partsOf(text)) {
        const auto mass = positive(part, "a weight in g");
        if (!mass) return failure(mass);
        masses.push_back(*mass);
    }
    std::ranges::sort(masses);
    if (masses.size() == 1 || std::ranges::adjacent_find(masses) != masses.end()) {
        return fail(ErrorCode::InvalidArgument, "weights_g is {}; two or more different weights, or none, are expected",
                    text);
    }
    return masses;
}

}  // namespace tacto::host::sensor_calibration
