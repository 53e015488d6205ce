#include "app/gui/live/ProfileFields.h"

#include <QCoreApplication>

namespace tacto::gui {

namespace {

#define WORDS(text) QT_TRANSLATE_NOOP("Profile", text)

using Tab = ProfileTab;
const std::vector<std::pair<const char*, const char*>> kCurves{
    {"linear", WORDS("linear")}, {"logarithmic", WORDS("logarithmic")}, {"power", WORDS("power, x^(1/β)")}};

const std::vector<ProfileField>& fields() {
    static const std::vector<ProfileField> all{
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "assignment",
         .label = WORDS("Assignment"),
         .unit = "",
         .tip = WORDS("Which feeling sets which part of the train."),
         .choices = {{"texture_to_amplitude", WORDS("R → amplitude, P → interval")},
                     {"swapped", WORDS("P → amplitude, R → interval")}}},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "amplitude_min_v",
         .label = WORDS("Smallest amplitude"),
         .unit = "V",
         .tip = WORDS("At index 0: the smoothest surface, or when swapped the lightest touch."),
         .low = 0.01,
         .high = 500},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "amplitude_max_v",
         .label = WORDS("Largest amplitude"),
         .unit = "V",
         .tip = WORDS("At index 1. The limits of the output hold whatever stands here."),
         .low = 0.01,
         .high = 500},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "amplitude_curve",
         .label = WORDS("Its curve"),
         .unit = "",
         .tip = WORDS("The course from the smallest to the largest amplitude."),
         .choices = kCurves},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "amplitude_beta",
         .label = WORDS("Its exponent β"),
         .unit = "",
         .tip = WORDS("Of the power curve: above 1 the low end rises faster."),
         .low = 0.1,
         .high = 10,
         .needs = "amplitude_curve",
         .needsValue = "power"},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "amplitude_ratio_per_train",
         .label = WORDS("Largest ratio of amplitudes"),
         .unit = "",
         .tip = WORDS("Of one train to the one before, either way; 1.21 is two just-noticeable differences. 0: no "
                      "limit."),
         .low = 0,
         .high = 1000,
         .accepts = WORDS("0, or above 1 to 1000")},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "amplitude_slew_v_per_s",
         .label = WORDS("Largest change of amplitude"),
         .unit = "V/s",
         .tip = WORDS("From one train to the next, per second between them. 0: no limit."),
         .low = 0,
         .high = 1e6},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "hold",
         .label = WORDS("Held when the impedance changes"),
         .unit = "",
         .tip = WORDS("Voltage: the amplitude stays as encoded. Charge per phase or energy per pulse: the amplitude "
                      "follows the impedance from where it was when armed, within the limits."),
         .choices = {{"voltage", WORDS("voltage")},
                     {"charge", WORDS("charge per phase")},
                     {"energy", WORDS("energy per pulse")}}},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "interval_min_s",
         .label = WORDS("Shortest interval"),
         .unit = "s",
         .tip = WORDS("At index 1, from onset to onset. Longer than a train lasts."),
         .low = 0.01,
         .high = 60},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "interval_max_s",
         .label = WORDS("Longest interval"),
         .unit = "s",
         .tip = WORDS("At index 0, from onset to onset."),
         .low = 0.01,
         .high = 60},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "interval_curve",
         .label = WORDS("Its curve"),
         .unit = "",
         .tip = WORDS("The course from the longest to the shortest interval."),
         .choices = kCurves},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "interval_beta",
         .label = WORDS("Its exponent β"),
         .unit = "",
         .tip = WORDS("Of the power curve: above 1 the low end falls faster."),
         .low = 0.1,
         .high = 10,
         .needs = "interval_curve",
         .needsValue = "power"},
        {.tab = Tab::Encoding,
         .section = "encoding",
         .key = "interval_ratio_per_train",
         .label = WORDS("Largest ratio of intervals"),
         .unit = "",
         .tip = WORDS(
             "Of one interval to the one before, either way; 1.3456 is two just-noticeable differences. 0: no limit."),
         .low = 0,
         .high = 1000,
         .accepts = WORDS("0, or above 1 to 1000")},

        {.tab = Tab::Pulse,
         .section = "encoding",
         .key = "shape",
         .label = WORDS("Shape"),
         .unit = "",
         .tip = WORDS("Biphasic pulses take back the charge of their first phase."),
         .choices = {{"symmetric", WORDS("biphasic, symmetric")},
                     {"asymmetric", WORDS("biphasic, asymmetric")},
                     {"monophasic", WORDS("monophasic (bench loads only)")}},
         .alsoCalled = "pulse shape"},
        {.tab = Tab::Pulse,
         .section = "encoding",
         .key = "polarity",
         .label = WORDS("Leading phase"),
         .unit = "",
         .tip = WORDS("Sign of the first phase."),
         .choices = {{"positive", WORDS("positive")}, {"negative", WORDS("negative")}}},
        {.tab = Tab::Pulse,
         .section = "encoding",
         .key = "phase_width_us",
         .label = WORDS("Phase width"),
         .unit = "µs",
         .tip = WORDS("Duration of the leading phase."),
         .low = 1,
         .high = 1e5,
         .alsoCalled = "phase width"},
        {.tab = Tab::Pulse,
         .section = "encoding",
         .key = "inter_phase_gap_us",
         .label = WORDS("Inter-phase gap"),
         .unit = "µs",
         .tip = WORDS("From the end of the first phase to the second."),
         .low = 0,
         .high = 1e5,
         .needs = "shape",
         .needsValue = "!monophasic",
         .alsoCalled = "inter-phase gap"},
        {.tab = Tab::Pulse,
         .section = "encoding",
         .key = "recharge_ratio",
         .label = WORDS("Recharge ratio"),
         .unit = "",
         .tip = WORDS("The second phase is this many times longer and lower, with the same charge."),
         .low = 1,
         .high = 1000,
         .openLow = true,
         .needs = "shape",
         .needsValue = "asymmetric",
         .alsoCalled = "recharge ratio"},
        {.tab = Tab::Pulse,
         .section = "encoding",
         .key = "pulses",
         .label = WORDS("Pulses in a train"),
         .unit = "",
         .tip = WORDS("A whole number."),
         .low = 1,
         .high = 1000},
        {.tab = Tab::Pulse,
         .section = "encoding",
         .key = "rate_hz",
         .label = WORDS("Intra-train rate"),
         .unit = "Hz",
         .tip = WORDS("Rate of the pulses within a train. A train lasts pulses / rate."),
         .low = 0.1,
         .high = 1e4,
         .alsoCalled = "intra-train rate"},

        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "spectral_feature",
         .label = WORDS("From the vibration"),
         .unit = "",
         .tip = WORDS("The share of the rough band in the vibration, or its power for the force."),
         .choices = {{"h", WORDS("share of the rough band")}, {"h_abs", WORDS("power for the force")}}},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "band_low_hz",
         .label = WORDS("Rough band from"),
         .unit = "Hz",
         .tip = WORDS("Its upper end is 1 kHz."),
         .low = 5,
         .high = 1000,
         .openHigh = true},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "spectral_weight",
         .label = WORDS("Weight of the vibration"),
         .unit = "",
         .tip = WORDS("Against the weight of the taxels."),
         .low = 0,
         .high = 1e6},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "taxel_feature",
         .label = WORDS("From the taxels"),
         .unit = "",
         .tip = WORDS("How unevenly they are pressed, or how unevenly they change."),
         .choices = {{"static", WORDS("unevenness")}, {"dynamic", WORDS("unevenness of change")}}},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "taxel_weight",
         .label = WORDS("Weight of the taxels"),
         .unit = "",
         .tip = WORDS("Against the weight of the vibration."),
         .low = 0,
         .high = 1e6},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "smoothing_s",
         .label = WORDS("Smoothing of R"),
         .unit = "s",
         .tip = WORDS("Time constant: longer is calmer and later."),
         .low = 0,
         .high = 60,
         .openLow = true},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "contact_area_cm2",
         .label = WORDS("Contact area"),
         .unit = "cm²",
         .tip = WORDS("Turns force into pressure where there are no taxels in Pa."),
         .low = 0,
         .high = 1e4,
         .openLow = true},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "pressure_min_pa",
         .label = WORDS("Pressure of P = 0"),
         .unit = "Pa",
         .tip = WORDS("Lighter touches count as 0."),
         .low = 0,
         .high = 1e9},
        {.tab = Tab::Touch,
         .section = "roughness",
         .key = "pressure_max_pa",
         .label = WORDS("Pressure of P = 1"),
         .unit = "Pa",
         .tip = WORDS("Firmer touches count as 1."),
         .low = 0,
         .high = 1e9,
         .openLow = true,
         .accepts = WORDS("Pa, above that of P = 0")},

        {.tab = Tab::Load,
         .section = "safety",
         .key = "load_low_ohm",
         .label = WORDS("Smallest load"),
         .unit = "Ω",
         .tip = WORDS("The range in which a person's impedance must lie, and the worst case of previews."),
         .low = 0,
         .high = 1e12,
         .openLow = true},
        {.tab = Tab::Load,
         .section = "safety",
         .key = "load_high_ohm",
         .label = WORDS("Largest load"),
         .unit = "Ω",
         .tip = WORDS("The range in which a person's impedance must lie."),
         .low = 0,
         .high = 1e12,
         .openLow = true},
        {.tab = Tab::Load,
         .section = "safety",
         .key = "electrode_area_cm2",
         .label = WORDS("Electrode area"),
         .unit = "cm²",
         .tip = WORDS("Of the smaller electrode. Without it, limits of density are not evaluated."),
         .low = 0,
         .high = 1e12,
         .openLow = true,
         .mayBeEmpty = true},
    };
    return all;
}

#undef WORDS

}  // namespace

QString profileWords(const char* text) { return QCoreApplication::translate("Profile", text); }

QString titleOf(ProfileTab tab) {
    switch (tab) {
        case ProfileTab::Encoding:
            return QObject::tr("&Encoding");
        case ProfileTab::Pulse:
            return QObject::tr("&Pulse train");
        case ProfileTab::Touch:
            return QObject::tr("&Touch");
        case ProfileTab::Load:
            break;
    }
    return QObject::tr("&Load");
}

QString ProfileField::range() const {
    if (isChoice()) return {};
    const QString ending = *unit == 0 ? QString() : QStringLiteral("\u202f") + QString::fromUtf8(unit);
    if (accepts != nullptr) return profileWords(accepts);
    const QString from = QString::number(low, 'g', 10), to = QString::number(high, 'g', 10);
    QString text;
    if (high >= 1e6)
        text = openLow ? QObject::tr("above %1").arg(from) : QObject::tr("%1 or more").arg(from);
    else
        text = (openLow    ? QObject::tr("above %1 to %2")
                : openHigh ? QObject::tr("%1 to below %2")
                           : QObject::tr("%1 to %2"))
                   .arg(from, to);
    text += ending;
    return mayBeEmpty ? QObject::tr("%1, or empty").arg(text) : text;
}

std::span<const ProfileField> profileFields() { return fields(); }

const ProfileField* fieldIn(const QString& refusal) {
    const ProfileField* found = nullptr;
    qsizetype first = refusal.size();
    for (const auto& field : fields()) {
        for (const char* name : {field.key, field.alsoCalled}) {
            if (name == nullptr) continue;
            const auto at = refusal.indexOf(QLatin1String(name));
            if (at < 0 || at >= first) continue;
            first = at;
            found = &field;
        }
    }
    return found;
}

}  // namespace tacto::gui
