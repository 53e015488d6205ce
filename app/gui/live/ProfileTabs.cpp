#include "app/gui/live/ProfileTabs.h"

#include <QCoreApplication>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/LocaleFreeText.h"
#include "core/bench/Profile.h"

namespace tacto::gui {

ProfileTabs::ProfileTabs(QWidget* parent) : QTabWidget(parent) {
    for (int tab = 0; tab < kProfileTabs; ++tab)
        addTab(buildTab(static_cast<ProfileTab>(tab)), titleOf(static_cast<ProfileTab>(tab)));
}

QWidget* ProfileTabs::buildTab(ProfileTab tab) {
    auto* area = new QScrollArea(this);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* page = new QWidget(area);
    auto* form = new QFormLayout(page);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    for (const auto& field : profileForm()) {
        if (field.tab != tab) continue;
        auto row = buildRow(field, page);
        auto* holder = new QWidget(page);
        auto* column = new QVBoxLayout(holder);
        column->setContentsMargins(0, 0, 0, 0);
        column->setSpacing(0);
        auto* across = new QHBoxLayout;
        if (row.box != nullptr) {
            across->addWidget(row.box, 1);
        } else {
            across->addWidget(row.line);
            across->addSpacing(8);
            auto* range = new QLabel(field.range(), holder);
            setTone(*range, Tone::Quiet);
            across->addWidget(range, 1);
        }
        column->addLayout(across);
        column->addWidget(row.refusal);
        row.label->setBuddy(row.box != nullptr ? static_cast<QWidget*>(row.box) : row.line);
        form->addRow(row.label, holder);
        rows_.push_back(row);
    }
    area->setWidget(page);
    area->setMinimumWidth(page->sizeHint().width() + fontMetrics().averageCharWidth() * 4);
    return area;
}

ProfileTabs::Row ProfileTabs::buildRow(const ProfileField& field, QWidget* page) {
    Row row;
    row.field = &field;
    row.label = new QLabel(profileWords(field.label), page);
    row.refusal = new QLabel(page);
    row.refusal->setObjectName(QString("%1.refusal").arg(field.key));
    row.refusal->setWordWrap(true);
    row.refusal->hide();
    QWidget* input = nullptr;
    if (field.isChoice()) {
        input = row.box = new QComboBox(page);
        for (std::size_t i = 0; i < field.words.size(); ++i)
            row.box->addItem(profileWords(field.words[i]), qtext(field.stored->words[i]));
        connect(row.box, &QComboBox::currentIndexChanged, this, &ProfileTabs::edited);
    } else {
        input = row.line = new QLineEdit(page);
        row.line->setAlignment(Qt::AlignRight);
        row.line->setFixedWidth(fontMetrics().horizontalAdvance("000000000000"));
        connect(row.line, &QLineEdit::textChanged, this, &ProfileTabs::edited);
    }
    input->setObjectName(field.key);
    input->setToolTip(profileWords(field.tip));
    row.label->setToolTip(profileWords(field.tip));
    return row;
}

void ProfileTabs::goTo(const QString& key) {
    for (const auto& row : rows_) {
        if (row.field->key != key) continue;
        setCurrentIndex(int(row.field->tab));
        QWidget* input = row.box;
        if (row.line != nullptr) {
            row.line->selectAll();
            input = row.line;
        }
        input->setFocus();
    }
}

void ProfileTabs::fill(const nlohmann::json& document) {
    for (auto& row : rows_) {
        const auto& value = document.at(row.field->section()).at(row.field->key);
        if (row.box != nullptr)
            row.box->setCurrentIndex(row.box->findData(QString::fromStdString(value.get<std::string>())));
        else
            row.line->setText(value.is_number()
                                  ? QString::number(value.get<double>(), 'g', QLocale::FloatingPointShortest)
                                  : QString());
    }
}

std::optional<ProfileTabs::Refusal> ProfileTabs::read(nlohmann::json& document) const {
    for (const auto& row : rows_) {
        auto& value = document[row.field->section()][row.field->key];
        if (row.box != nullptr) {
            value = row.box->currentData().toString().toStdString();
            continue;
        }
        const auto text = row.line->text().trimmed();
        if (text.isEmpty() && row.field->stored->mayBeNull) {
            value = nullptr;
            continue;
        }
        const auto number = parseNumber(text.toStdString());
        if (!number || !std::isfinite(*number))
            return Refusal{row.field, tr("\"%1\" is not a number; %2 is expected").arg(text, row.field->range())};
        value = *number;
    }
    return std::nullopt;
}

void ProfileTabs::mark(const ProfileField* field, const QString& refusal) {
    for (auto& row : rows_) {
        const bool wrong = field == row.field;
        row.refusal->setText(wrong ? "⚠ " + refusal : QString());
        row.refusal->setVisible(wrong);
        auto amber = palette();
        amber.setColor(QPalette::WindowText, colours().amberText);
        row.refusal->setPalette(amber);
    }
    for (int tab = 0; tab < kProfileTabs; ++tab) {
        const bool wrong = field != nullptr && field->tab == static_cast<ProfileTab>(tab);
        setTabText(tab, titleOf(static_cast<ProfileTab>(tab)) + (wrong ? " ⚠" : ""));
    }
    enableWhatMatters();
}

void ProfileTabs::enableWhatMatters() {
    for (auto& row : rows_) {
        if (row.field->needs == nullptr) continue;
        const auto chosen = findChild<QComboBox*>(row.field->needs)->currentData().toString();
        QString needed = row.field->needsValue;
        const bool matters = needed.startsWith('!') ? chosen != needed.mid(1) : chosen == needed;
        // A refused field can always be corrected.
        row.line->setEnabled(matters || !row.refusal->text().isEmpty());
        row.label->setEnabled(row.line->isEnabled());
    }
}

namespace {

#define WORDS(text) QT_TRANSLATE_NOOP("Profile", text)

using Tab = ProfileTab;
const std::vector<const char*> kCurves{WORDS("linear"), WORDS("logarithmic"), WORDS("power, x^(1/β)")};

ProfileField described(Tab tab, const char* key, const char* label, const char* tip,
                       std::vector<const char*> words = {}, const char* accepts = nullptr, const char* needs = nullptr,
                       const char* needsValue = nullptr) {
    return {tab, key, label, tip, std::move(words), accepts, needs, needsValue};
}

std::vector<ProfileField> describedFields() {
    return {
        described(Tab::Encoding, "assignment", WORDS("Assignment"),
                  WORDS("Which feeling sets which part of the train."),
                  {WORDS("R → amplitude, P → interval"), WORDS("P → amplitude, R → interval")}),
        described(Tab::Encoding, "amplitude_min_v", WORDS("Smallest amplitude"),
                  WORDS("At index 0: the smoothest surface, or when swapped the lightest touch.")),
        described(Tab::Encoding, "amplitude_max_v", WORDS("Largest amplitude"),
                  WORDS("At index 1. The output limits always apply.")),
        described(Tab::Encoding, "amplitude_curve", WORDS("Its curve"),
                  WORDS("The course from the smallest to the largest amplitude."), kCurves),
        described(Tab::Encoding, "amplitude_beta", WORDS("Its exponent β"),
                  WORDS("Exponent of the power curve: above 1 the low end rises faster."), {}, nullptr,
                  "amplitude_curve", "power"),
        described(
            Tab::Encoding, "amplitude_ratio_per_train", WORDS("Largest ratio of amplitudes"),
            WORDS("From one train to the next, either way; 1.21 is two just-noticeable differences. 0: no limit."), {},
            WORDS("0, or above 1 to 1000")),
        described(Tab::Encoding, "amplitude_slew_v_per_s", WORDS("Largest change of amplitude"),
                  WORDS("From one train to the next, per second between them. 0: no limit.")),
        described(
            Tab::Encoding, "hold", WORDS("Held when the impedance changes"),
            WORDS(
                "Voltage: the amplitude stays as encoded. Charge per phase or energy per pulse: the amplitude follows "
                "the impedance from where it was when armed, within the limits."),
            {WORDS("voltage"), WORDS("charge per phase"), WORDS("energy per pulse")}),
        described(Tab::Encoding, "interval_min_s", WORDS("Shortest interval"),
                  WORDS("At index 1, from onset to onset. Longer than a train lasts.")),
        described(Tab::Encoding, "interval_max_s", WORDS("Longest interval"),
                  WORDS("At index 0, from onset to onset.")),
        described(Tab::Encoding, "interval_curve", WORDS("Its curve"),
                  WORDS("The course from the longest to the shortest interval."), kCurves),
        described(Tab::Encoding, "interval_beta", WORDS("Its exponent β"),
                  WORDS("Exponent of the power curve: above 1 the low end falls faster."), {}, nullptr,
                  "interval_curve", "power"),
        described(
            Tab::Encoding, "interval_ratio_per_train", WORDS("Largest ratio of intervals"),
            WORDS("From one interval to the next, either way; 1.3456 is two just-noticeable differences. 0: no limit."),
            {}, WORDS("0, or above 1 to 1000")),

        described(
            Tab::Pulse, "shape", WORDS("Shape"), WORDS("Biphasic pulses take back the charge of their first phase."),
            {WORDS("biphasic, symmetric"), WORDS("biphasic, asymmetric"), WORDS("monophasic (bench loads only)")}),
        described(Tab::Pulse, "polarity", WORDS("Leading phase"), WORDS("Sign of the first phase."),
                  {WORDS("positive"), WORDS("negative")}),
        described(Tab::Pulse, "phase_width_us", WORDS("Phase width"), WORDS("Duration of the leading phase.")),
        described(Tab::Pulse, "inter_phase_gap_us", WORDS("Inter-phase gap"),
                  WORDS("From the end of the first phase to the second."), {}, nullptr, "shape", "!monophasic"),
        described(Tab::Pulse, "recharge_ratio", WORDS("Recharge ratio"),
                  WORDS("The second phase is this many times longer and lower, with the same charge."), {},
                  WORDS("above 1 to 1000"), "shape", "asymmetric"),
        described(Tab::Pulse, "pulses", WORDS("Pulses in a train"), WORDS("A whole number.")),
        described(Tab::Pulse, "rate_hz", WORDS("Intra-train rate"),
                  WORDS("Rate of the pulses within a train. A train lasts pulses / rate.")),

        described(Tab::Touch, "spectral_feature", WORDS("From the vibration"),
                  WORDS("The share of the rough band in the vibration, or its power for the force."),
                  {WORDS("share of the rough band"), WORDS("power for the force")}),
        described(Tab::Touch, "band_low_hz", WORDS("Rough band from"), WORDS("Its upper end is 1 kHz.")),
        described(Tab::Touch, "spectral_weight", WORDS("Weight of the vibration"),
                  WORDS("Against the weight of the taxels.")),
        described(Tab::Touch, "taxel_feature", WORDS("From the taxels"),
                  WORDS("How unevenly they are pressed, or how unevenly they change."),
                  {WORDS("unevenness"), WORDS("unevenness of change")}),
        described(Tab::Touch, "taxel_weight", WORDS("Weight of the taxels"),
                  WORDS("Against the weight of the vibration.")),
        described(Tab::Touch, "smoothing_s", WORDS("Smoothing of R"),
                  WORDS("Time constant: longer is calmer and later.")),
        described(Tab::Touch, "contact_area_cm2", WORDS("Contact area"),
                  WORDS("Turns force into pressure where there are no taxels in Pa.")),
        described(Tab::Touch, "pressure_min_pa", WORDS("Pressure of P = 0"), WORDS("Lighter touches count as 0.")),
        described(Tab::Touch, "pressure_max_pa", WORDS("Pressure of P = 1"), WORDS("Firmer touches count as 1."), {},
                  WORDS("Pa, above that of P = 0")),

        described(Tab::Load, "load_low_ohm", WORDS("Smallest load"),
                  WORDS("The range in which a person's impedance must lie, and the worst case of previews.")),
        described(Tab::Load, "load_high_ohm", WORDS("Largest load"),
                  WORDS("The range in which a person's impedance must lie.")),
        described(Tab::Load, "electrode_area_cm2", WORDS("Electrode area"),
                  WORDS("Area of the smaller electrode. Without it, limits of density are not evaluated.")),
    };
}

#undef WORDS

}  // namespace

const std::vector<ProfileField>& profileForm() {
    static const auto all = [] {
        static const auto sections = profileFields().kind().info;
        auto fields = describedFields();
        for (auto& field : fields) field.stored = sections.find(field.section())->find(field.key);
        return fields;
    }();
    return all;
}

QString profileWords(const char* text) { return QCoreApplication::translate("Profile", text); }

QString titleOf(ProfileTab tab) {
    const QString titles[kProfileTabs] = {QObject::tr("&Encoding"), QObject::tr("&Pulse train"), QObject::tr("&Touch"),
                                          QObject::tr("&Load")};
    return titles[static_cast<std::size_t>(tab)];
}

const char* ProfileField::section() const noexcept {
    return tab == ProfileTab::Touch ? "roughness" : tab == ProfileTab::Load ? "safety" : "encoding";
}

QString ProfileField::range() const {
    if (isChoice()) return {};
    if (accepts != nullptr) return profileWords(accepts);
    const auto& numbers = *stored->numbers;
    const auto from = grouped(QString::number(numbers.low, 'g', 10));
    const auto to = grouped(QString::number(numbers.high, 'g', 10));
    QString text;
    if (numbers.high >= 1e6)
        text = numbers.openLow ? QObject::tr("above %1").arg(from) : QObject::tr("%1 or more").arg(from);
    else
        text = (numbers.openLow    ? QObject::tr("above %1 to %2")
                : numbers.openHigh ? QObject::tr("%1 to below %2")
                                   : QObject::tr("%1 to %2"))
                   .arg(from, to);
    // After a word the unit stands apart; after a number no line may break before it.
    if (!numbers.unit.empty()) text += (text.back().isDigit() ? QChar(0x202f) : QChar(' ')) + qtext(numbers.unit);
    return stored->mayBeNull ? QObject::tr("%1, or empty").arg(text) : text;
}

const ProfileField* fieldIn(const QString& refusal) {
    const ProfileField* found = nullptr;
    qsizetype first = refusal.size();
    for (const auto& field : profileForm()) {
        const QString key = field.key;
        for (const auto& name : {key, QString(key).replace('_', ' ')}) {
            const auto at = refusal.indexOf(name);
            if (at < 0 || at >= first) continue;
            first = at;
            found = &field;
        }
    }
    return found;
}

QString inFormWords(QString refusal) {
    for (const auto& field : profileForm()) {
        const auto section = QString(field.section()) + ": ";
        if (refusal.startsWith(section)) refusal.remove(0, section.size());
        const QRegularExpression key(QString(R"("?\b%1\b"?)").arg(field.key));
        refusal.replace(key, QString("“%1”").arg(profileWords(field.label)));
    }
    return sentence(grouped(refusal));
}

}  // namespace tacto::gui

#include "moc_ProfileTabs.cpp"
