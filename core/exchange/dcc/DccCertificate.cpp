#include "core/exchange/dcc/DccCertificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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
                           kTimeWords[] = {"time base", "timebase", "clock", "frequency", "sampl", "time interval"},
                           kClockWords[] = {"time base", "timebase", "clock"},
                           kGainWords[] = {"gain", "vertical", "amplitude", "voltage"},
                           kSurelyGain[] = {"gain", "vertical"},
                           kOther[] = {"rise",     "fall",     "bandwidth", "jitter",     "offset",     "trigger",
                                       "noise",    "ripple",   "response",  "flatness",   "supply",     "mains",
                                       "temperat", "humidity", "tolerance", "input resi", "input impe", "verdict"},
                           kErrorWords[] = {"error", "deviation"};
constexpr Known kKnown[] = {{"probe_u_pct", kProbeWords, "\\volt"},
                            {"shunt_u_pct", kShuntWords, "\\ohm"},
                            {"timebase_u_ppm", kTimeWords, "\\second,\\hertz"},
                            {"gain_u_pct", kGainWords, "\\volt"}};
constexpr const Known& kProbeFigure = kKnown[0];
constexpr const Known& kShuntFigure = kKnown[1];
constexpr const Known& kTimeFigure = kKnown[2];
constexpr const Known& kGainFigure = kKnown[3];

bool says(std::string_view text, Words words) {
    return std::ranges::any_of(words, [&](std::string_view each) { return text.find(each) != std::string_view::npos; });
}

std::string ownText(const DccQuantity& quantity) {
    std::string text = quantity.name;
    for (const auto& each : quantity.refTypes) text += " " + each;
    return lowered(text);
}

const CertificateFigure& figureOf(const Known& known) {
    return *std::ranges::find(kCertificateFigures, known.key, &CertificateFigure::key);
}

enum class Part { Other, Reference, Nominal, Measured, Error };

Part partOf(const DccQuantity& quantity) {
    if (quantity.is(dcc::kError) || says(lowered(quantity.name), kErrorWords)) return Part::Error;
    if (quantity.is(dcc::kReference)) return Part::Reference;
    if (quantity.is(dcc::kNominal)) return Part::Nominal;
    return quantity.is(dcc::kMeasured) ? Part::Measured : Part::Other;
}

/// A quantity, and what is known of it.
struct Seen {
    const DccQuantity* quantity;
    std::optional<DsiUnit> unit;
    Part part;
    const Known* figure = nullptr;  ///< null: none that is used here
    bool called = false;            ///< by a word of the figure that nothing else is called by
    std::string trouble{};          ///< why the figure cannot be read from it; empty: none
    bool unclear = false;           ///< an error without unit of its own, in a list of several figures

    [[nodiscard]] bool isNumber() const { return unit && unit->sameKind({}); }
    [[nodiscard]] bool isLike(const Seen& other) const { return unit && other.unit && unit->sameKind(*other.unit); }
    [[nodiscard]] double value(std::size_t i) const { return quantity->values[i] * unit->factor; }
};
using List = std::span<const Seen>;

/// The largest figure so far, and what it is made of; relative.
struct Largest {
    double uncertainty = 0, error = 0, k = 2;
    bool found = false;
    std::string trouble{};  ///< why it cannot be read from the certificate, in one sentence; empty: none
    [[nodiscard]] double sum() const noexcept { return uncertainty + error; }
};

/// Reads the figures of one certificate. What it cannot tell it does not guess: such a figure has `trouble`.
class FigureReader {
public:
    /// `item`: of several items the one that counts; nothing: not known. `added`: beside the instrument's own.
    FigureReader(const DccFile& file, std::optional<std::size_t> item, bool added) : file_(file), item_(item) {
        for (std::size_t i = 0; i < file.items.size(); ++i)
            if (!item || *item == i) words_ += lowered(file.items[i].name + " " + file.items[i].model + " ");
        accessory_ = added && (says(words_, kProbeWords) || says(words_, kShuntWords));
        read();
    }
    [[nodiscard]] const Largest& of(std::string_view key) const {
        return largest_[static_cast<std::size_t>(std::ranges::find(kKnown, key, &Known::key) - std::begin(kKnown))];
    }

private:
    void read() {
        std::map<std::size_t, std::vector<Seen>> lists;
        for (const auto& quantity : file_.quantities) {
            if (isOfAnother(quantity) || says(ownText(quantity), kOther)) continue;
            lists[quantity.list].push_back(seen(quantity));
        }
        for (auto& [number, list] : lists) {
            settle(list);
            for (const auto& each : list)
                if (each.figure != nullptr && !each.quantity->uncertainties.empty()) take(each, list);
        }
        for (const auto& [number, list] : lists) noteMissing(list);
        for (const auto& known : kKnown) {
            auto& largest = of(known);
            const auto& figure = tacto::figureOf(known);
            const double most = figure.most * figure.perUnit;
            if (largest.found && largest.trouble.empty() && !(largest.sum() > 0 && largest.sum() <= most))
                largest.trouble = fmt::format("its {} would be {:.6g} {}; above 0 to {} {} is accepted", figure.title,
                                              largest.sum() / figure.perUnit, figure.unit, figure.most, figure.unit);
        }
    }
    [[nodiscard]] Largest& of(const Known& figure) { return largest_[static_cast<std::size_t>(&figure - kKnown)]; }

    /// Whether it is about another item than the one that counts.
    [[nodiscard]] bool isOfAnother(const DccQuantity& quantity) const {
        return item_ && !quantity.items.empty() && std::ranges::find(quantity.items, *item_) == quantity.items.end();
    }
    [[nodiscard]] bool isSurelyOurs(const DccQuantity& quantity) const {
        return file_.items.size() == 1 || (item_ && quantity.items == std::vector{*item_});
    }

    [[nodiscard]] static bool fits(const Seen& one, const Known& figure) {
        const auto allowed = split(figure.units, ',');
        return one.isNumber() || (one.unit && std::ranges::any_of(allowed, [&](std::string_view each) {
                                      return one.unit->sameKind(*dsiUnit(each));
                                  }));
    }

    [[nodiscard]] Seen seen(const DccQuantity& quantity) const {
        Seen one{.quantity = &quantity, .unit = dsiUnit(quantity.unit), .part = partOf(quantity)};
        const auto own = ownText(quantity), around = lowered(quantity.within);
        // The name of the innermost list or result that has one.
        const auto end = around.find_last_not_of("; ");
        const auto inner = end == std::string::npos ? std::string_view() : std::string_view(around).substr(0, end + 1);
        const auto begin = inner.rfind("; ");
        const auto innermost = begin == std::string_view::npos ? inner : inner.substr(begin + 2);
        if (says(innermost, kOther) && !says(own, kSurelyGain) && !says(innermost, kSurelyGain)) return one;
        for (const auto& figure : kKnown) {
            if (!says(own, figure.words) || (accessory_ && &figure == &kGainFigure)) continue;
            one.called = says(own + around, kClockWords);
            if (fits(one, figure)) {
                one.figure = &figure;
                return one;
            }
            // Thermometers have probes too, and everything has a frequency.
            if (&figure == &kProbeFigure || (&figure == &kTimeFigure && !says(own, kClockWords))) continue;
            one.figure = &figure;
            one.trouble = fmt::format("\"{}\" is in {}; {}, \\one, \\percent or \\ppm is expected",
                                      shownOf(quantity.name), shownOf(quantity.unit), figure.units);
            return one;
        }
        one.called = says(around, kClockWords);
        for (const auto& figure : kKnown) {
            if (accessory_ && &figure == &kGainFigure) continue;
            const bool byUnit = &figure == &kGainFigure && !one.isNumber();
            const bool byItem = (&figure == &kProbeFigure || &figure == &kShuntFigure) && says(words_, figure.words);
            if (fits(one, figure) && (byUnit || byItem || says(around, figure.words))) {
                one.figure = &figure;
                return one;
            }
        }
        return one;
    }

    /// What the quantities of a list say of each other.
    static void settle(std::span<Seen> list) {
        const bool hasVolts = std::ranges::any_of(list, [](const Seen& each) {
            return (each.figure == &kGainFigure || each.figure == &kProbeFigure) && !each.isNumber();
        });
        for (auto& each : list)  // the frequency at which volts were measured
            if (hasVolts && each.figure == &kTimeFigure && !each.called) each.figure = nullptr;
        const Known* only = nullptr;
        bool several = false;
        for (const auto& each : list) {
            if (each.figure == nullptr) continue;
            several = several || (only != nullptr && only != each.figure);
            only = each.figure;
        }
        for (auto& each : list) {
            if (each.part != Part::Error || each.figure != nullptr || (each.unit && !each.isNumber())) continue;
            each.unclear = several;
            if (!several) each.figure = only;
        }
    }

    /// The quantity of the same list and kind that is that part of it.
    [[nodiscard]] static Result<const Seen*> beside(const Seen& one, List list, Part part) {
        const Seen* found = nullptr;
        for (const auto& each : list) {
            if (&each == &one || each.part != part || !each.isLike(one)) continue;
            if (found != nullptr)
                return invalid("\"{}\" stands in a list with several reference or nominal values; one is expected",
                               shownOf(one.quantity->name));
            found = &each;
        }
        if (found != nullptr && found->quantity->values.size() != one.quantity->values.size())
            return invalid("\"{}\" has {} values and \"{}\" beside it {}; as many are expected",
                           shownOf(one.quantity->name), one.quantity->values.size(), shownOf(found->quantity->name),
                           found->quantity->values.size());
        return found;
    }
    /// The value to which an error or a reading belongs.
    [[nodiscard]] static Result<const Seen*> baseOf(const Seen& one, List list) {
        if (one.part == Part::Reference) return &one;
        auto base = beside(one, list, Part::Reference);
        if (!base || *base != nullptr || one.part == Part::Nominal) return base;
        return beside(one, list, Part::Nominal);
    }

    /// The errors and the readings beside a quantity that say how far it is off.
    struct Off {
        std::vector<const Seen*> errors{}, readings{};
    };
    [[nodiscard]] static Result<Off> offOf(const Seen& one, List list) {
        Off off;
        for (const auto& each : list) {
            if (&each == &one) continue;
            const bool reads = each.part == Part::Measured && each.isLike(one);
            const bool errs = each.part == Part::Error && (each.isLike(one) || each.figure == one.figure);
            if (each.unclear)
                return invalid(
                    "\"{}\" stands in a list with several figures; a word of the one that it belongs to is "
                    "expected in its name",
                    shownOf(each.quantity->name));
            if (!reads && !errs) continue;
            if (!each.unit || (!each.isLike(one) && !each.isNumber()))
                return invalid("the error \"{}\" is in {}; {}, \\one, \\percent or \\ppm is expected",
                               shownOf(each.quantity->name), shownOf(each.quantity->unit), one.quantity->unit);
            if (each.quantity->values.size() != one.quantity->values.size())
                return invalid("\"{}\" has {} values and \"{}\" beside it {}; as many are expected",
                               shownOf(one.quantity->name), one.quantity->values.size(), shownOf(each.quantity->name),
                               each.quantity->values.size());
            (errs ? off.errors : off.readings).push_back(&each);
        }
        return off;
    }

    void take(const Seen& one, List list) {
        auto& largest = of(*one.figure);
        auto point = one.trouble.empty() ? worstOf(one, list) : Result<Largest>(invalid("{}", one.trouble));
        if (point && point->found && !isSurelyOurs(*one.quantity))
            point = invalid("it is about {} items, and \"{}\" does not say by a refId of which one", file_.items.size(),
                            shownOf(one.quantity->name));
        if (!point) {
            if (largest.trouble.empty()) largest.trouble = point.error().message;
        } else if (point->found && (!largest.found || point->sum() > largest.sum())) {
            point->trouble = largest.trouble;
            largest = *point;
        }
    }

    /// The worst point of one quantity; not found: it says nothing of the figure.
    [[nodiscard]] static Result<Largest> worstOf(const Seen& one, List list) {
        const auto base = baseOf(one, list);
        if (!base) return failure(base);
        if (one.part == Part::Nominal && *base != nullptr) return Largest{};  // the reference says it better
        if (one.part == Part::Error) return worstError(one, *base, list);
        const auto off = offOf(one, list);
        if (!off) return failure(off);
        const bool isBase = one.part == Part::Reference || one.part == Part::Nominal;
        const bool known = !off->errors.empty() || (isBase ? !off->readings.empty() : *base != nullptr);
        if (one.figure == &kTimeFigure && !one.called && !known)
            return Largest{};  // a frequency at which all was measured
        if (!known && !one.isNumber() && (one.figure != &kShuntFigure || one.part == Part::Measured))
            return invalid(
                "\"{}\" states values in {} without their error; a quantity {}, {} or {} in the same list is "
                "expected",
                shownOf(one.quantity->name), one.quantity->unit, dcc::kError, dcc::kReference, dcc::kNominal);
        Largest worst;
        for (std::size_t i = 0; i < one.quantity->values.size(); ++i) {
            const double value = one.value(i);
            double at = std::abs(*base != nullptr ? (*base)->value(i) : value), most = 0;
            const auto consider = [&](double error) { most = std::isnan(error) ? error : std::max(most, error); };
            for (const auto* each : off->errors) {
                const bool same = each->isLike(one) && (!one.isNumber() || each->unit->factor == one.unit->factor);
                consider(std::abs(each->value(i)) * (same ? 1 : at));
            }
            // A stated error counts before the distance from what was nominally set.
            if (isBase) {
                for (const auto* each : off->readings)
                    if (one.part == Part::Reference || off->errors.empty()) consider(std::abs(each->value(i) - value));
            } else if (*base != nullptr && ((*base)->part == Part::Reference || off->errors.empty())) {
                consider(std::abs(value - (*base)->value(i)));
            } else if (!known) {
                const auto ideal = idealOf(one, value);
                if (!ideal) return failure(ideal);
                most = std::isnan(value) ? value : std::abs(value - *ideal);
                at = *ideal == 0 ? 1 : std::abs(*ideal);
            }
            if (auto done = add(one, i, at, most, worst); !done) return failure(done);
        }
        return worst;
    }

    [[nodiscard]] static Result<Largest> worstError(const Seen& one, const Seen* base, List list) {
        if (base == nullptr && !one.isNumber()) {
            const auto read = beside(one, list, Part::Measured);
            if (!read) return failure(read);
            base = *read;
        }
        if (base == nullptr && !one.isNumber())
            return invalid(
                "\"{}\" is an error in {} without the values that it belongs to; a quantity of the same list "
                "with the refType {} is expected",
                shownOf(one.quantity->name), one.quantity->unit, dcc::kReference);
        // An error in \percent is relative, also beside a ratio in \one.
        if (base != nullptr && one.isNumber() && base->unit->factor != one.unit->factor) base = nullptr;
        Largest worst;
        for (std::size_t i = 0; i < one.quantity->values.size(); ++i) {
            double most = std::abs(one.value(i));
            if (base != nullptr && base->part == Part::Reference) {
                for (const auto& each : list)
                    if (each.part == Part::Measured && each.isLike(one) && i < each.quantity->values.size())
                        most = std::max(most, std::abs(each.value(i) - base->value(i)));
            }
            if (auto done = add(one, i, base == nullptr ? 1 : std::abs(base->value(i)), most, worst); !done)
                return failure(done);
        }
        return worst;
    }

    /// Adds one point: U brought to k = 2, but never below what is stated (with few degrees of freedom k is larger).
    [[nodiscard]] static Result<void> add(const Seen& one, std::size_t i, double at, double error, Largest& worst) {
        const double k = one.quantity->coverageFactors[i];
        const double u = one.quantity->uncertainties[i] * one.unit->factor * std::max(1.0, 2 / k);
        if (std::isnan(one.value(i)) || std::isnan(u) || std::isnan(k) || std::isnan(at) || std::isnan(error))
            return invalid("value {} of \"{}\", its error or its uncertainty is NaN; numbers are expected for the {}",
                           i + 1, shownOf(one.quantity->name), tacto::figureOf(*one.figure).title);
        if (at == 0) return {};  // a zero says nothing of a gain
        const Largest point{.uncertainty = u / at, .error = error / at, .k = std::max(2.0, k), .found = true};
        if (!worst.found || point.sum() > worst.sum()) worst = point;
        return {};
    }

    /// From what a single number without reference is off: a deviation from 0, a gain from 1; a shunt and the whole
    /// factor of a probe are used as they are stated.
    [[nodiscard]] static Result<double> idealOf(const Seen& one, double value) {
        constexpr double kDeviation = 0.25, kGainLike = 2;
        const double size = std::abs(value);
        if (!one.isNumber() || std::isnan(value)) return value;
        const bool factor = one.figure == &kProbeFigure && one.unit->factor == 1;
        if (size <= kDeviation && !(factor && size > 0)) return 0.0;
        if (size > kDeviation && size <= kGainLike) return 1.0;
        if (factor && value == std::floor(value)) return value;
        return invalid("\"{}\" is {} {} without a nominal value; one is expected in the same list",
                       shownOf(one.quantity->name), value / one.unit->factor, one.quantity->unit);
    }

    /// An error that stands there without any uncertainty may be larger than all that have one.
    void noteMissing(List list) {
        for (const auto& each : list) {
            if (each.figure == nullptr || !each.quantity->uncertainties.empty()) continue;
            const bool reads =
                each.part == Part::Measured && std::ranges::any_of(list, [&](const Seen& other) {
                    return other.isLike(each) && (other.part == Part::Reference || other.part == Part::Nominal);
                });
            const bool used = std::ranges::any_of(list, [&](const Seen& other) {
                return other.figure == each.figure && !other.quantity->uncertainties.empty();
            });
            auto& largest = of(*each.figure);
            if (used || !(reads || each.part == Part::Error) || !largest.found || !largest.trouble.empty()) continue;
            largest.trouble =
                fmt::format("\"{}\" states an error without its uncertainty", shownOf(each.quantity->name));
        }
    }

    const DccFile& file_;
    std::optional<std::size_t> item_;
    std::string words_;
    bool accessory_ = false;
    std::array<Largest, std::size(kKnown)> largest_{};
};

/// A text or figure that the file says: `given` may say the same.
Result<void> agree(std::string_view what, const std::string& given, const std::string& said) {
    if (given.empty() || given == said) return {};
    return invalid("the {} was given as \"{}\" and the certificate says \"{}\"; one of them is expected", what,
                   shownOf(given), shownOf(said));
}

/// The day of an xs:date, without its time zone.
Result<CalibrationDate> dayOf(std::string_view what, const std::string& text) {
    const auto date = parseDate(std::string_view(text).substr(0, std::string_view("2026-11-21").size()));
    if (!date) return invalid("its {} is \"{}\"; a day as 2026-11-21 is expected", what, shownOf(text));
    return *date;
}

std::string joined(const std::string& before, const std::string& next) {
    if (before.empty() || before == next) return next;
    return before + " + " + next;
}

/// The item that counts, as an index; nothing: not known.
std::optional<std::size_t> itemOf(const DccFile& file, const std::string& serial) {
    if (file.items.size() == 1) return 0;
    const auto found = std::ranges::find(file.items, serial, &DccItem::serial);
    if (serial.empty() || found == file.items.end()) return std::nullopt;
    return static_cast<std::size_t>(found - file.items.begin());
}

/// Instrument and serial number, which its own certificate alone states.
Result<void> takeItem(const DccFile& file, const Certificate& given, Certificate& into) {
    const auto index = itemOf(file, given.serial);
    if (!index) return invalid("it is about {} items; the serial number of one of them is expected", file.items.size());
    const auto* item = &file.items[*index];
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
    if (file.recalibrations.empty() && !given.due.ok())
        return invalid("it states no day on which it is due (a statement {} with a date); it must be given",
                       dcc::kRecalibration);
    for (const auto& text : file.recalibrations) {
        const auto due = dayOf("day of recalibration", text);
        if (!due) return failure(due);
        if (!into.due.ok() || *due < into.due) into.due = *due;
    }
    return {};
}

std::string signedText(const DccFile& file) {
    const auto& [there, signer, fingerprint] = file.signature;
    if (!there) return fmt::format("certificate {} is unsigned", shownOf(file.number));
    if (fingerprint.empty())
        return fmt::format("the signature of certificate {} fits; its key has no certificate that names anybody",
                           shownOf(file.number));
    return fmt::format(
        "the signature of certificate {} fits; its own certificate names {}, which nobody vouches for here, and has "
        "the SHA-256 fingerprint {}",
        shownOf(file.number), signer.empty() ? "nobody" : signer, fingerprint);
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
    into.notes.push_back(signedText(file));
    return {};
}

/// A figure that may come from one of the files or be given.
class FigureTaker {
public:
    FigureTaker(std::span<const DccFile> files, const Certificate& given) : files_(files), given_(given) {
        for (const auto& file : files) read_.emplace_back(file, itemOf(file, given.serial), &file != files.data());
    }
    [[nodiscard]] Result<void> take(const CertificateFigure& figure, DccCertificate& into) const {
        const DccFile* by = nullptr;
        const Largest* largest = nullptr;
        std::string trouble;
        for (std::size_t i = 0; i < files_.size(); ++i) {
            const auto& found = read_[i].of(figure.key);
            if (!found.trouble.empty() && trouble.empty())
                trouble = fmt::format("certificate {}: {}", shownOf(files_[i].number), found.trouble);
            if (!found.found) continue;
            if (largest != nullptr && trouble.empty())
                trouble = fmt::format("certificates {} and {} both state the {}; one of them is expected",
                                      shownOf(by->number), shownOf(files_[i].number), figure.title);
            by = &files_[i];
            largest = &found;
        }
        auto& known = into.certificate.*figure.member;
        const auto& entered = given_.*figure.member;
        if (trouble.empty() && largest != nullptr) return takeRead(figure, *largest, into);
        if (!trouble.empty() && !entered) return invalid("{}; U of the {} may be given", trouble, figure.title);
        if (!trouble.empty()) into.notes.push_back(fmt::format("U of the {} is as given: {}", figure.title, trouble));
        known = entered;
        if (!known && figure.required)
            return invalid(
                "{} states no {} with its uncertainty (a quantity in \\volt, or one that is called gain in "
                "\\percent or \\one), which must be given beside it",
                files_.size() == 1 ? "the certificate" : "none of the certificates", figure.title);
        return {};
    }

private:
    [[nodiscard]] Result<void> takeRead(const CertificateFigure& figure, const Largest& read,
                                        DccCertificate& into) const {
        const double unit = figure.perUnit;
        const auto u = parseNumber(fmt::format("{:.12g}", read.sum() / unit));  // 0.7, not 0.7000000000000001
        const auto& entered = given_.*figure.member;
        if (entered && *entered != *u)
            return invalid("U of the {} was given as {} {} and the certificate states {}; one of them is expected",
                           figure.title, *entered, figure.unit, *u);
        into.certificate.*figure.member = u;
        if (read.error > 0 || read.k > 2)
            into.notes.push_back(fmt::format(
                "{}: U (k = {:.4g}{}) {:.4g} {}{}", figure.title, read.k, read.k > 2 ? ", taken as it is stated" : "",
                read.uncertainty / unit, figure.unit,
                read.error > 0 ? fmt::format(" and the error {:.4g} {}, for which readings are not corrected",
                                             read.error / unit, figure.unit)
                               : std::string()));
        return {};
    }

    std::span<const DccFile> files_;
    const Certificate& given_;
    std::vector<FigureReader> read_;
};

}  // namespace

Result<DccCertificate> certificateFrom(std::span<const DccFile> files, const Certificate& given) {
    DccCertificate read;
    auto& certificate = read.certificate;
    for (const auto& file : files) {
        if (auto done = takeFile(file, &file == files.data(), given, read); !done)
            return invalid("certificate {}: {}", shownOf(file.number), done.error().message);
    }
    if (auto same = agree("certificate number", given.number, certificate.number); !same) return failure(same);
    if (auto same = agree("laboratory", given.by, certificate.by); !same) return failure(same);
    if (given.date.ok() && given.date != certificate.date)
        if (auto same = agree("date", dateText(given.date), dateText(certificate.date)); !same) return failure(same);
    if (given.due.ok() && (!certificate.due.ok() || given.due < certificate.due)) certificate.due = given.due;
    const FigureTaker figures(files, given);
    for (const auto& figure : kCertificateFigures)
        if (auto taken = figures.take(figure, read); !taken) return failure(taken);
    if (auto sound = check(certificate); !sound) return failure(sound);
    return read;
}

bool statesGain(const DccFile& file) {
    const auto gain = FigureReader(file, itemOf(file, {}), true).of(kGainFigure.key);
    return gain.found || !gain.trouble.empty();
}

}  // namespace tacto
