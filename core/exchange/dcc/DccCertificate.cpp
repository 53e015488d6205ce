#include "core/exchange/dcc/DccCertificate.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/exchange/dcc/DccNames.h"
#include "core/exchange/dcc/DsiUnit.h"

namespace tacto {

namespace {

using Words = std::span<const std::string_view>;

/// How a quantity is known to be a figure.
struct Known {
    std::string_view key;    ///< of kCertificateFigures
    Words words;             ///< one of them stands in its name or in what it is part of
    std::string_view units;  ///< those it may have beside numbers, by one of each kind, with a comma between
};
constexpr std::string_view kProbeWords[] = {"probe", "attenuat"}, kShuntWords[] = {"shunt"},
                           kTimeWords[] = {"time base", "timebase", "frequency", "sampl", "clock", "time interval"},
                           kGainWords[] = {"gain", "vertical", "amplitude", "voltage"},
                           kOther[] = {"rise",    "fall",  "bandwidth", "jitter",     "offset",
                                       "trigger", "noise", "ripple",    "input resi", "input impe"},
                           kErrorWords[] = {"error", "deviation"};
constexpr Known kKnown[] = {{"probe_u_pct", kProbeWords, "\\volt"},
                            {"shunt_u_pct", kShuntWords, "\\ohm"},
                            {"timebase_u_ppm", kTimeWords, "\\second,\\hertz"},
                            {"gain_u_pct", kGainWords, "\\volt"}};

bool says(std::string_view text, Words words) {
    return std::ranges::any_of(words, [&](std::string_view each) { return text.find(each) != std::string_view::npos; });
}

std::string ownText(const DccQuantity& quantity) {
    std::string text = quantity.name;
    for (const auto& each : quantity.refTypes) text += " " + each;
    return lowered(text);
}

bool isError(const DccQuantity& quantity) {
    return quantity.is(dcc::kError) || says(lowered(quantity.name), kErrorWords);
}

/// The largest figure so far, and what it is made of; relative.
struct Largest {
    double uncertainty = 0, error = 0;
    bool found = false;
    [[nodiscard]] double sum() const noexcept { return uncertainty + error; }
};

class FigureReader {
public:
    explicit FigureReader(const DccFile& file) : file_(file) {
        for (const auto& item : file.items) item_ += lowered(item.name + " " + item.model + " ");
    }

    [[nodiscard]] Result<void> read() {
        for (const auto& quantity : file_.quantities) {
            if (quantity.uncertainties.empty()) continue;
            auto figure = figureOf(quantity);
            if (!figure) return failure(figure);
            if (*figure == nullptr) continue;
            if (auto done = take(quantity, **figure); !done) return done;
        }
        return {};
    }
    [[nodiscard]] const Largest& of(std::string_view key) const {
        return largest_[static_cast<std::size_t>(std::ranges::find(kKnown, key, &Known::key) - std::begin(kKnown))];
    }

private:
    [[nodiscard]] static bool fits(const DsiUnit& unit, const Known& figure) {
        const auto allowed = split(figure.units, ',');
        return unit.sameKind({}) ||
               std::ranges::any_of(allowed, [&](std::string_view each) { return unit.sameKind(*dsiUnit(each)); });
    }

    /// Null: none that is used here.
    [[nodiscard]] Result<const Known*> figureOf(const DccQuantity& quantity) const {
        const auto own = ownText(quantity), around = lowered(quantity.within) + " " + item_;
        if (says(own, kOther)) return nullptr;
        const auto unit = dsiUnit(quantity.unit);
        for (const auto& figure : kKnown) {
            if (!says(own, figure.words)) continue;
            if (unit && fits(*unit, figure)) return &figure;
            if (figure.words.data() == kProbeWords) continue;  // thermometers have probes too
            return invalid("\"{}\" is in {}; {}, \\one, \\percent or \\ppm is expected", printable(quantity.name),
                           printable(quantity.unit), figure.units);
        }
        for (const auto& figure : kKnown) {
            const bool byUnit = &figure == &std::end(kKnown)[-1] && !unit.value_or(DsiUnit{}).sameKind({});
            if (unit && fits(*unit, figure) && (byUnit || says(around, figure.words))) return &figure;
        }
        return nullptr;
    }

    /// The quantity of the same list with that reference type, in a unit of the same kind.
    [[nodiscard]] const DccQuantity* beside(const DccQuantity& quantity, const DsiUnit& unit,
                                            std::string_view refType) const {
        for (const auto& each : file_.quantities) {
            if (each.list != quantity.list || &each == &quantity || !each.is(refType)) continue;
            const auto other = dsiUnit(each.unit);
            if (other && other->sameKind(unit) && each.values.size() == quantity.values.size()) return &each;
        }
        return nullptr;
    }

    [[nodiscard]] Result<void> take(const DccQuantity& quantity, const Known& figure) {
        const auto unit = *dsiUnit(quantity.unit);
        const bool number = unit.sameKind({}), error = isError(quantity);
        const DccQuantity *base = nullptr, *read = nullptr;
        for (const char* each : {dcc::kReference, dcc::kNominal, dcc::kMeasured})
            if (base == nullptr && !quantity.is(each)) base = beside(quantity, unit, each);
        if (!error && quantity.is(dcc::kReference)) read = beside(quantity, unit, dcc::kMeasured);
        if (error && !number && base == nullptr)
            return invalid(
                "\"{}\" is an error in {} without the values that it belongs to; a quantity of the same list "
                "with the refType {} is expected",
                printable(quantity.name), quantity.unit, dcc::kReference);
        // What is measured is known only by its place beside a reference.
        const bool deviates = !error && base != nullptr && !quantity.is(dcc::kReference) && !base->is(dcc::kMeasured);
        const double other = base == nullptr ? 1 : dsiUnit(base->unit)->factor;
        auto& largest = largest_[static_cast<std::size_t>(&figure - std::begin(kKnown))];
        for (std::size_t i = 0; i < quantity.values.size(); ++i) {
            const double value = quantity.values[i] * unit.factor;
            const double u = quantity.uncertainties[i] * unit.factor * 2 / quantity.coverageFactors[i];
            double at = std::abs(value), off = 0;
            if (error && !number) {
                at = std::abs(base->values[i] * other);
                off = std::abs(value);
            } else if (deviates) {
                at = std::abs(base->values[i] * other);
                off = std::abs(value - base->values[i] * other);
            } else if (read != nullptr) {
                off = std::abs(read->values[i] * dsiUnit(read->unit)->factor - value);
            } else if (number && (error || at <= 2)) {  // a gain near 1, or how far it is from 1
                off = error ? at : std::min(at, std::abs(value - 1));
                at = 1;
            }
            if (std::isnan(value) || std::isnan(u) || std::isnan(at) || std::isnan(off))
                return invalid("value {} of \"{}\" or its uncertainty is NaN; numbers are expected for the {}", i + 1,
                               printable(quantity.name), titleOf(figure.key));
            if (at == 0) continue;  // a zero says nothing of a gain
            const Largest point{u / at, off / at, true};
            if (!largest.found || point.sum() > largest.sum()) largest = point;
        }
        return {};
    }

    [[nodiscard]] static std::string_view titleOf(std::string_view key) {
        return std::ranges::find(kCertificateFigures, key, &CertificateFigure::key)->title;
    }

    const DccFile& file_;
    std::string item_;
    std::array<Largest, std::size(kKnown)> largest_{};
};

/// A text or figure that the file says: `given` may say the same.
Result<void> agree(std::string_view what, const std::string& given, const std::string& said) {
    if (given.empty() || given == said) return {};
    return invalid("the {} was given as \"{}\" and the certificate says \"{}\"; one of them is expected", what, given,
                   printable(said));
}

/// The day of an xs:date, without its time zone.
Result<CalibrationDate> dayOf(std::string_view what, const std::string& text) {
    const auto date = parseDate(std::string_view(text).substr(0, std::string_view("2026-11-21").size()));
    if (!date) return invalid("its {} is \"{}\"; a day as 2026-11-21 is expected", what, printable(text));
    return *date;
}

std::string joined(const std::string& before, const std::string& next) {
    if (before.empty() || before == next) return next;
    return before + " + " + next;
}

const DccItem* itemOf(const DccFile& file, const std::string& serial) {
    if (file.items.size() == 1) return &file.items.front();
    const auto found = std::ranges::find(file.items, serial, &DccItem::serial);
    return serial.empty() || found == file.items.end() ? nullptr : &*found;
}

/// Instrument and serial number, which its own certificate alone states.
Result<void> takeItem(const DccFile& file, const Certificate& given, Certificate& into) {
    const auto* item = itemOf(file, given.serial);
    if (item == nullptr)
        return invalid("it is about {} items; the serial number of one of them is expected", file.items.size());
    into.instrument = item->manufacturer;
    const auto& model = item->model.empty() ? item->name : item->model;
    if (!model.empty()) into.instrument += (into.instrument.empty() ? "" : " ") + model;
    if (into.instrument.empty()) into.instrument = given.instrument;
    // A name is a matter of taste, a serial number is not.
    if (!given.instrument.empty()) into.instrument = given.instrument;
    if (auto same = item->serial.empty() ? Result<void>() : agree("serial number", given.serial, item->serial); !same)
        return same;
    into.serial = item->serial.empty() ? given.serial : item->serial;
    if (into.serial.empty()) return invalid("it states no serial number of the item, which must be given beside it");
    return {};
}

Result<void> takeDays(const DccFile& file, const Certificate& given, Certificate& into) {
    const auto ended = dayOf("endPerformanceDate", file.ended);
    if (!ended) return failure(ended);
    if (!into.date.ok() || *ended > into.date) into.date = *ended;
    if (file.recalibration.empty()) {
        if (!given.due.ok())
            return invalid("it states no day on which it is due (a statement {} with a date); it must be given",
                           dcc::kRecalibration);
        return {};
    }
    const auto due = dayOf("day of recalibration", file.recalibration);
    if (!due) return failure(due);
    if (!into.due.ok() || *due < into.due) into.due = *due;
    return {};
}

Result<void> takeFigures(const DccFile& file, DccCertificate& into) {
    FigureReader figures(file);
    if (auto read = figures.read(); !read) return read;
    for (const auto& figure : kCertificateFigures) {
        auto& known = into.certificate.*figure.member;
        const auto& found = figures.of(figure.key);
        if (!found.found || known) continue;
        const double unit = figure.perUnit;
        known = parseNumber(fmt::format("{:.12g}", found.sum() / unit));  // 0.7, not 0.7000000000000001
        if (found.error > 0)
            into.notes.push_back(
                fmt::format("{}: U (k = 2) {:.4g} {} and the error {:.4g} {}, for which readings are not corrected",
                            figure.title, found.uncertainty / unit, figure.unit, found.error / unit, figure.unit));
    }
    return {};
}

std::string signedText(const DccFile& file) {
    if (!file.signature.there) return fmt::format("certificate {} is unsigned", printable(file.number));
    return fmt::format("certificate {} is as {} signed it; who that is, this program cannot tell",
                       printable(file.number),
                       file.signature.signer.empty() ? "the holder of a key without a name" : file.signature.signer);
}

Result<void> takeFile(const DccFile& file, bool first, const Certificate& given, DccCertificate& into) {
    auto& certificate = into.certificate;
    if (file.simulated) return invalid("it is of a simulated bench: nothing was measured on hardware");
    if (first) {
        if (auto item = takeItem(file, given, certificate); !item) return item;
    }
    certificate.number = joined(certificate.number, file.number);
    certificate.by = joined(certificate.by, file.laboratory);
    if (auto days = takeDays(file, given, certificate); !days) return days;
    if (auto figures = takeFigures(file, into); !figures) return figures;
    into.notes.push_back(signedText(file));
    return {};
}

}  // namespace

Result<DccCertificate> certificateFrom(std::span<const DccFile> files, const Certificate& given) {
    DccCertificate read;
    auto& certificate = read.certificate;
    for (const auto& file : files) {
        if (auto done = takeFile(file, &file == files.data(), given, read); !done)
            return invalid("certificate {}: {}", printable(file.number), done.error().message);
    }
    if (auto same = agree("certificate number", given.number, certificate.number); !same) return failure(same);
    if (auto same = agree("laboratory", given.by, certificate.by); !same) return failure(same);
    if (given.date.ok() && given.date != certificate.date)
        if (auto same = agree("date", dateText(given.date), dateText(certificate.date)); !same) return failure(same);
    if (given.due.ok() && (!certificate.due.ok() || given.due < certificate.due)) certificate.due = given.due;
    for (const auto& figure : kCertificateFigures) {
        auto& known = certificate.*figure.member;
        const auto& entered = given.*figure.member;
        if (entered && known && *entered != *known)
            return invalid("U of the {} was given as {} {} and the certificate states {}; one of them is expected",
                           figure.title, *entered, figure.unit, *known);
        if (!known) known = entered;
        if (!known && figure.required)
            return invalid(
                "{} states no {} with its uncertainty (a quantity in \\volt, or one that is called gain in "
                "\\percent or \\one), which must be given beside it",
                files.size() == 1 ? "the certificate" : "none of the certificates", figure.title);
    }
    if (auto sound = check(certificate); !sound) return failure(sound);
    return read;
}

}  // namespace tacto
