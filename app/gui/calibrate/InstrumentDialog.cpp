#include "app/gui/calibrate/InstrumentDialog.h"

#include <QDialogButtonBox>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/TypedNumber.h"

namespace tacto::gui {

namespace {

constexpr int kInstrumentChars = 64;  // width in characters

QString kindTitle(InstrumentKind kind) {
    switch (kind) {
        case InstrumentKind::Oscilloscope:
            return QObject::tr("Oscilloscope");
        case InstrumentKind::Shunt:
            return QObject::tr("Shunt");
        case InstrumentKind::Probe:
            break;
    }
    return QObject::tr("Probe");
}

/// Returns "R100 (until 2027-03-01)", "⚠ R100 (certificate expired 2026-10-01)".
QString presetText(const InstrumentPreset& preset) {
    const auto name = qtext(preset.name);
    if (!preset.due) return QObject::tr("%1 (data sheet)").arg(name);
    const auto day = qtext(dateText(*preset.due));
    return preset.expired(utcToday()) ? QObject::tr("⚠ %1 (certificate expired %2)").arg(name, day)
                                      : QObject::tr("%1 (until %2)").arg(name, day);
}

}  // namespace

InstrumentDialog::InstrumentDialog(QWidget* parent) : QDialog(parent) {
    setObjectName("instrumentDialog");
    setWindowTitle(tr("Saved instruments"));
    auto* column = new QVBoxLayout(this);
    column->addWidget(heading(tr("Measured with"), this));
    buildChoice(*column);
    column->addWidget(heading(tr("Save an instrument"), this));
    buildForm(*column);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    use_ = buttons->addButton(tr("&Use these"), QDialogButtonBox::ActionRole);
    use_->setObjectName("useInstruments");
    use_->setToolTip(tr("Writes the address among the devices of the run."));
    makePrimary(*use_);
    column->addWidget(buttons);
    use_->setAutoDefault(false);
    connect(use_, &QPushButton::clicked, this, [this] {
        emit chosen(address_->text());
        accept();
    });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    read();
    judge();
    setMinimumWidth(fontMetrics().averageCharWidth() * kInstrumentChars);
}

void InstrumentDialog::buildChoice(QVBoxLayout& column) {
    const auto line = [this](const char* name) {
        auto* label = makeLabel({}, {.name = name, .wraps = true, .selectable = true}, this);
        return label;
    };
    address_ = line("instrumentAddress");
    said_ = line("instrumentSays");
    std::vector<FormField> fields;
    for (const auto& [word, kind] : kInstrumentKinds)
        fields.push_back(choiceField(word.data(), kindTitle(kind), {{"", tr("none")}},
                                     tr("Saved instruments of this kind, and until when their certificates are "
                                        "valid.")));
    fields.push_back(ownField(tr("Address"), address_));
    fields.push_back(ownField({}, said_));
    choice_ = new FieldForm(this, FieldForm::Labels::Beside);
    choice_->show(fields);
    connect(choice_, &FieldForm::edited, this, &InstrumentDialog::compose);
    column.addWidget(choice_);
}

void InstrumentDialog::buildForm(QVBoxLayout& column) {
    std::vector<std::pair<QString, QString>> kinds;
    for (const auto& [word, kind] : kInstrumentKinds) kinds.emplace_back(qtext(word), kindTitle(kind));
    form_ = new FieldForm(this, FieldForm::Labels::Beside);
    form_->show(
        {choiceField("presetKind", tr("&Kind"), kinds, {}),
         textField("presetName", tr("&Name"), {},
                   tr("What the laboratory calls it. Saving the same name again replaces it.")),
         textField("presetSerial", tr("S&erial number"), {}, tr("May be left empty.")),
         textField("presetAddress", tr("&Address"), {},
                   tr("How it is reached, as sigrok:rigol-ds:conn=tcp-raw/192.0.2.1/5555?voltage=CH1&current=CH2.")),
         textField("presetOhms", tr("&Resistance (Ω)"), {}, tr("Resistance of the current shunt.")),
         textField("presetAccuracy", tr("A&ccuracy (± %)"), {},
                   tr("Gain of an oscilloscope, tolerance of a shunt or probe, 0 to 50 %. Empty: not known."),
                   tr("not known")),
         textField("presetTimeBase", tr("&Time base (± ppm)"), {}, tr("0 to 100000 ppm. Empty: not known."),
                   tr("not known")),
         dayField("presetDue", tr("Certificate &due"),
                  tr("The last day on which its figures hold, as 2027-03-01. Empty: figures of the data sheet."),
                  tr("data sheet"))});
    column.addWidget(form_);
    trouble_ = makeLabel({}, {.name = "presetTrouble", .wraps = true}, this);
    column.addWidget(trouble_);
    auto* row = new QHBoxLayout;
    save_ = pageButton(tr("&Save"), "savePreset", tr("Keeps it for this and all later runs."), this);
    remove_ = pageButton(
        tr("Re&move"), "removePreset",
        tr("Forgets the saved instrument of this kind and name. Sessions keep what they were measured with."), this);
    row->addStretch();
    addAll(*row, {remove_, save_});
    column.addLayout(row);
    connect(form_, &FieldForm::edited, this, &InstrumentDialog::judge);
    connect(save_, &QPushButton::clicked, this, &InstrumentDialog::save);
    connect(remove_, &QPushButton::clicked, this, &InstrumentDialog::remove);
}

InstrumentKind InstrumentDialog::formKind() const {
    return valueFor(kInstrumentKinds, form_->text("presetKind").toStdString()).value_or(InstrumentKind::Oscilloscope);
}

void InstrumentDialog::read() {
    const auto presets = InstrumentPresets::open(instrumentFile());
    all_.clear();
    if (presets) all_ = presets->all();
    for (const auto& [word, kind] : kInstrumentKinds) {
        std::vector<std::pair<QString, QString>> choices{{"", tr("none")}};
        for (const auto& one : all_)
            if (one.kind == kind) choices.emplace_back(qtext(one.name), presetText(one));
        choice_->setChoices(std::string(word), choices);
    }
    compose();
    if (!presets) {
        said_->setText(tr("⚠ %1 No saved instrument is used.").arg(sentence(presets.error())));
        setTone(*said_, Tone::Warning);
    }
}

ChosenInstruments InstrumentDialog::picked() const {
    const auto of = [&](InstrumentKind kind) -> std::optional<InstrumentPreset> {
        const auto name = choice_->text(std::string(nameOf(kind))).toStdString();
        for (const auto& one : all_) {
            if (one.kind == kind && one.name == name) return one;
        }
        return std::nullopt;
    };
    return {of(InstrumentKind::Oscilloscope), of(InstrumentKind::Shunt), of(InstrumentKind::Probe)};
}

void InstrumentDialog::compose() {
    const auto what = picked();
    const auto address = composed(what, utcToday());
    const bool any = what.oscilloscope.has_value();
    address_->setText(any ? qtext(address.text) : QString("–"));
    QStringList said;
    for (const auto& one : address.said) said << qtext(one);
    setTone(*said_, any && !said.isEmpty() ? Tone::Warning : Tone::Quiet);
    said_->setText(!any             ? tr("Choose an oscilloscope, or save one below.")
                   : said.isEmpty() ? tr("Everything that an uncertainty needs is stated.")
                                    : said.join(" "));
    if (use_ != nullptr) use_->setEnabled(any);
}

Result<InstrumentPreset> InstrumentDialog::written() const {
    InstrumentPreset out;
    out.kind = formKind();
    out.name = form_->text("presetName").toStdString();
    out.serial = form_->text("presetSerial").toStdString();
    if (out.name.empty()) return fail(ErrorCode::InvalidArgument, "the name is missing");
    const auto number = [this](const char* field, const char* title, std::optional<double>& into) -> Result<void> {
        const auto text = form_->text(field).toStdString();
        if (text.empty()) return {};
        into = typedNumber(text);
        if (into) return {};
        return fail(ErrorCode::InvalidArgument, "{} is \"{}\"; a number is expected{}", title, text,
                    typedTrouble(text));
    };
    if (out.kind == InstrumentKind::Oscilloscope) {
        out.address = form_->text("presetAddress").toStdString();
        if (auto read = number("presetTimeBase", "Time base (± ppm)", out.timeBase_ppm); !read) return failure(read);
    }
    if (out.kind == InstrumentKind::Shunt) {
        if (auto read = number("presetOhms", "Resistance (Ω)", out.ohms); !read) return failure(read);
    }
    if (auto read = number("presetAccuracy", "Accuracy (± %)", out.accuracy_pct); !read) return failure(read);
    if (const auto day = form_->text("presetDue").toStdString(); !day.empty()) {
        out.due = parseDate(day);
        if (!out.due)
            return fail(ErrorCode::InvalidArgument, "the due date is \"{}\"; a day as 2027-03-01 is expected", day);
    }
    if (auto sound = check(out); !sound) return failure(sound);
    return out;
}

void InstrumentDialog::judge() {
    const auto kind = formKind();
    form_->setRowVisible("presetAddress", kind == InstrumentKind::Oscilloscope);
    form_->setRowVisible("presetTimeBase", kind == InstrumentKind::Oscilloscope);
    form_->setRowVisible("presetOhms", kind == InstrumentKind::Shunt);
    const auto preset = written();
    save_->setEnabled(preset.has_value());
    const auto name = form_->text("presetName").toStdString();
    remove_->setEnabled(
        std::ranges::any_of(all_, [&](const auto& one) { return one.kind == kind && one.name == name; }));
    QString says;
    if (!preset) {
        says = sentence(preset.error());
    } else if (preset->expired(utcToday())) {
        says = tr("Its certificate has expired: the instrument would be kept, but its figures would not be used.");
    }
    trouble_->setText(says);
}

void InstrumentDialog::save() {
    const auto preset = written();
    if (!preset) return;
    auto presets = InstrumentPresets::open(instrumentFile());
    if (!presets) return trouble_->setText(sentence(presets.error()));
    if (const auto saved = presets->save(*preset); !saved) return trouble_->setText(sentence(saved.error()));
    read();
    choice_->set(std::string(nameOf(preset->kind)), qtext(preset->name));
    judge();
    trouble_->setText(tr("%1 %2 is saved and chosen.").arg(kindTitle(preset->kind), qtext(preset->name)));
}

void InstrumentDialog::remove() {
    auto presets = InstrumentPresets::open(instrumentFile());
    if (!presets) return trouble_->setText(sentence(presets.error()));
    const auto name = form_->text("presetName");
    if (const auto gone = presets->remove(formKind(), name.toStdString()); !gone)
        return trouble_->setText(sentence(gone.error()));
    read();
    judge();
    trouble_->setText(tr("%1 %2 is removed.").arg(kindTitle(formKind()), name));
}

}  // namespace tacto::gui

#include "moc_InstrumentDialog.cpp"
