#include "app/gui/calibrate/InstrumentDialog.h"

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/theme/EntryFields.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/LocaleFreeText.h"

namespace tacto::gui {

namespace {

constexpr int kNameChars = 30;

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

/// "R100 (until 2027-03-01)", "⚠ R100 (certificate expired 2026-10-01)".
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
    column->addWidget(buildChoice());
    column->addWidget(heading(tr("Save an instrument"), this));
    column->addWidget(buildForm());
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    use_ = buttons->addButton(tr("&Use these"), QDialogButtonBox::ActionRole);
    use_->setObjectName("useInstruments");
    use_->setToolTip(tr("Writes the address among the devices of the run."));
    makePrimary(*use_);
    column->addWidget(buttons);
    for (auto* button : {use_, save_, remove_}) button->setAutoDefault(false);
    connect(use_, &QPushButton::clicked, this, [this] {
        emit chosen(address_->text());
        accept();
    });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    read();
    showFields();
}

QWidget* InstrumentDialog::buildChoice() {
    auto* holder = new QWidget(this);
    auto* form = new QFormLayout(holder);
    form->setContentsMargins(0, 0, 0, 0);
    for (const auto& [word, kind] : kInstrumentKinds) {
        auto* chooser = new QComboBox(holder);
        chooser->setObjectName(qtext(word));
        chooser->setAccessibleName(kindTitle(kind));
        chooser->setToolTip(tr("Saved instruments of this kind, and until when their certificates are valid."));
        chooser->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        chooser->setMinimumContentsLength(kNameChars);
        connect(chooser, &QComboBox::currentIndexChanged, this, &InstrumentDialog::compose);
        form->addRow(kindTitle(kind), chooser);
        choosers_[std::size_t(kind)] = chooser;
    }
    address_ = new QLabel(holder);
    address_->setObjectName("instrumentAddress");
    address_->setWordWrap(true);
    address_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    form->addRow(tr("Address"), address_);
    said_ = new QLabel(holder);
    said_->setObjectName("instrumentSays");
    said_->setWordWrap(true);
    form->addRow(said_);
    return holder;
}

QWidget* InstrumentDialog::buildForm() {
    auto* holder = new QWidget(this);
    form_ = new QFormLayout(holder);
    form_->setContentsMargins(0, 0, 0, 0);
    kind_ = new QComboBox(holder);
    kind_->setObjectName("presetKind");
    for (const auto& [word, kind] : kInstrumentKinds) kind_->addItem(kindTitle(kind), int(kind));
    form_->addRow(tr("&Kind"), kind_);
    const auto addRow = [&](const QString& title, QLineEdit& edit, QWidget& whole, const QString& tip) {
        edit.setToolTip(tip);
        edit.setAccessibleName(QString(title).remove('&'));
        form_->addRow(title, &whole);
        connect(&edit, &QLineEdit::textChanged, this, &InstrumentDialog::judge);
    };
    const auto field = [&](const QString& title, const char* name, const QString& tip) {
        auto* edit = new QLineEdit(holder);
        edit->setObjectName(name);
        addRow(title, *edit, *edit, tip);
        return edit;
    };
    name_ =
        field(tr("&Name"), "presetName", tr("What the laboratory calls it. Saving the same name again replaces it."));
    serial_ = field(tr("S&erial number"), "presetSerial", tr("May be left empty."));
    where_ = field(tr("&Address"), "presetAddress",
                   tr("How it is reached, as sigrok:rigol-ds:conn=tcp-raw/192.0.2.1/5555?voltage=CH1&current=CH2."));
    ohms_ = field(tr("&Resistance (Ω)"), "presetOhms", tr("Resistance of the current shunt."));
    accuracy_ = field(tr("A&ccuracy (± %)"), "presetAccuracy",
                      tr("Gain of an oscilloscope, tolerance of a shunt or probe, 0 to 50 %. Empty: not known."));
    timeBase_ = field(tr("&Time base (± ppm)"), "presetTimeBase", tr("0 to 100000 ppm. Empty: not known."));
    auto* due = new DayField("presetDue", tr("data sheet"), holder);
    due_ = &due->line();
    addRow(tr("Certificate &due"), *due_, *due,
           tr("The last day on which its figures hold, as 2027-03-01. Empty: figures of the data sheet."));
    for (auto* edit : {accuracy_, timeBase_}) edit->setPlaceholderText(tr("not known"));
    trouble_ = new QLabel(holder);
    trouble_->setObjectName("presetTrouble");
    trouble_->setWordWrap(true);
    form_->addRow(trouble_);
    auto* row = new QHBoxLayout;
    save_ = new QPushButton(tr("&Save"), holder);
    save_->setObjectName("savePreset");
    save_->setToolTip(tr("Keeps it for this and all later runs."));
    remove_ = new QPushButton(tr("Re&move"), holder);
    remove_->setObjectName("removePreset");
    remove_->setToolTip(
        tr("Forgets the saved instrument of this kind and name. Sessions keep what they were measured with."));
    row->addStretch();
    row->addWidget(remove_);
    row->addWidget(save_);
    form_->addRow(row);
    connect(kind_, &QComboBox::currentIndexChanged, this, &InstrumentDialog::showFields);
    connect(save_, &QPushButton::clicked, this, &InstrumentDialog::save);
    connect(remove_, &QPushButton::clicked, this, &InstrumentDialog::remove);
    return holder;
}

InstrumentKind InstrumentDialog::formKind() const { return InstrumentKind(kind_->currentData().toInt()); }

void InstrumentDialog::showFields() {
    const auto kind = formKind();
    form_->setRowVisible(where_, kind == InstrumentKind::Oscilloscope);
    form_->setRowVisible(timeBase_, kind == InstrumentKind::Oscilloscope);
    form_->setRowVisible(ohms_, kind == InstrumentKind::Shunt);
    judge();
}

void InstrumentDialog::read() {
    const auto presets = InstrumentPresets::open(instrumentFile());
    all_.clear();
    if (presets) all_ = presets->all();
    for (const auto& [word, kind] : kInstrumentKinds) {
        auto* chooser = choosers_[std::size_t(kind)];
        const QSignalBlocker quiet(chooser);
        const auto before = chooser->currentData();
        chooser->clear();
        chooser->addItem(tr("none"));
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (all_[i].kind == kind) chooser->addItem(presetText(all_[i]), qtext(all_[i].name));
        }
        chooser->setCurrentIndex(before.isValid() ? std::max(0, chooser->findData(before)) : 0);
    }
    compose();
    if (!presets) {
        said_->setText(tr("⚠ %1 No saved instrument is used.").arg(sentence(presets.error())));
        setTone(*said_, Tone::Warning);
    }
}

ChosenInstruments InstrumentDialog::picked() const {
    const auto of = [&](InstrumentKind kind) -> std::optional<InstrumentPreset> {
        const auto name = choosers_[std::size_t(kind)]->currentData().toString().toStdString();
        for (const auto& one : all_) {
            if (one.kind == kind && one.name == name) return one;
        }
        return std::nullopt;
    };
    return {of(InstrumentKind::Oscilloscope), of(InstrumentKind::Shunt), of(InstrumentKind::Probe)};
}

void InstrumentDialog::compose() {
    if (said_ == nullptr) return;
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
    out.name = name_->text().trimmed().toStdString();
    out.serial = serial_->text().trimmed().toStdString();
    if (out.name.empty()) return fail(ErrorCode::InvalidArgument, "the name is missing");
    const auto number = [](const QLineEdit& edit, std::optional<double>& into) -> Result<void> {
        const auto text = edit.text().trimmed().toStdString();
        if (text.empty()) return {};
        into = parseNumber(text);
        if (into) return {};
        return fail(ErrorCode::InvalidArgument, "{} is \"{}\"; a number is expected",
                    edit.accessibleName().toStdString(), text);
    };
    if (out.kind == InstrumentKind::Oscilloscope) {
        out.address = where_->text().trimmed().toStdString();
        if (auto read = number(*timeBase_, out.timeBase_ppm); !read) return failure(read);
    }
    if (out.kind == InstrumentKind::Shunt) {
        if (auto read = number(*ohms_, out.ohms); !read) return failure(read);
    }
    if (auto read = number(*accuracy_, out.accuracy_pct); !read) return failure(read);
    if (const auto day = due_->text().trimmed().toStdString(); !day.empty()) {
        out.due = parseDate(day);
        if (!out.due)
            return fail(ErrorCode::InvalidArgument, "the due date is \"{}\"; a day as 2027-03-01 is expected", day);
    }
    if (auto sound = check(out); !sound) return failure(sound);
    return out;
}

void InstrumentDialog::judge() {
    if (remove_ == nullptr) return;
    const auto preset = written();
    save_->setEnabled(preset.has_value());
    const auto name = name_->text().trimmed().toStdString();
    remove_->setEnabled(
        std::ranges::any_of(all_, [&](const auto& one) { return one.kind == formKind() && one.name == name; }));
    QString says;
    if (!preset) {
        says = name.empty() ? QString() : sentence(preset.error());
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
    auto* chooser = choosers_[std::size_t(preset->kind)];
    chooser->setCurrentIndex(std::max(0, chooser->findData(qtext(preset->name))));
    judge();
    trouble_->setText(tr("%1 %2 is saved and chosen.").arg(kindTitle(preset->kind), qtext(preset->name)));
}

void InstrumentDialog::remove() {
    auto presets = InstrumentPresets::open(instrumentFile());
    if (!presets) return trouble_->setText(sentence(presets.error()));
    const auto name = name_->text().trimmed();
    if (const auto gone = presets->remove(formKind(), name.toStdString()); !gone)
        return trouble_->setText(sentence(gone.error()));
    read();
    judge();
    trouble_->setText(tr("%1 %2 is removed.").arg(kindTitle(formKind()), name));
}

}  // namespace tacto::gui

#include "moc_InstrumentDialog.cpp"
