#include "app/gui/live/ProfileEditor.h"

#include <QFile>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSaveFile>
#include <QScrollArea>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"
#include "core/base/Text.h"

namespace tacto::gui {

namespace {

/// Keys of the profile's `encoding` section, as people read them.
struct NumberField {
    const char* key;
    const char* label;
    const char* unit;
    const char* tip;
};
constexpr NumberField kNumbers[] = {
    {"amplitude_min_v", QT_TRANSLATE_NOOP("Profile", "Smallest amplitude"), "V",
     QT_TRANSLATE_NOOP("Profile", "Amplitude of the smoothest surface.")},
    {"amplitude_max_v", QT_TRANSLATE_NOOP("Profile", "Largest amplitude"), "V",
     QT_TRANSLATE_NOOP("Profile", "Amplitude of the roughest surface; the paper's limit is 40 V.")},
    {"amplitude_beta", QT_TRANSLATE_NOOP("Profile", "Exponent β of its power curve"), "",
     QT_TRANSLATE_NOOP("Profile", "Only for the power curve: x to the power 1/β.")},
    {"interval_min_s", QT_TRANSLATE_NOOP("Profile", "Shortest interval"), "s",
     QT_TRANSLATE_NOOP("Profile", "Onset to onset at the firmest pressure.")},
    {"interval_max_s", QT_TRANSLATE_NOOP("Profile", "Longest interval"), "s",
     QT_TRANSLATE_NOOP("Profile", "Onset to onset at the lightest pressure.")},
    {"interval_beta", QT_TRANSLATE_NOOP("Profile", "Exponent β of its power curve"), "",
     QT_TRANSLATE_NOOP("Profile", "Only for the power curve: x to the power 1/β.")},
    {"phase_width_us", QT_TRANSLATE_NOOP("Profile", "Phase width"), "µs",
     QT_TRANSLATE_NOOP("Profile", "Duration of the leading phase.")},
    {"inter_phase_gap_us", QT_TRANSLATE_NOOP("Profile", "Inter-phase gap"), "µs",
     QT_TRANSLATE_NOOP("Profile", "From the end of the first phase to the second.")},
    {"recharge_ratio", QT_TRANSLATE_NOOP("Profile", "Recharge ratio"), "",
     QT_TRANSLATE_NOOP("Profile", "Only for asymmetric pulses: the second phase is this many times longer and lower.")},
    {"pulses", QT_TRANSLATE_NOOP("Profile", "Pulses in a train"), "",
     QT_TRANSLATE_NOOP("Profile", "A whole number from 1.")},
    {"rate_hz", QT_TRANSLATE_NOOP("Profile", "Intra-train rate"), "Hz",
     QT_TRANSLATE_NOOP("Profile", "Rate of the pulses within a train.")},
    {"amplitude_slew_v_per_s", QT_TRANSLATE_NOOP("Profile", "Largest change of amplitude"), "V/s",
     QT_TRANSLATE_NOOP("Profile", "0: no limit.")},
    {"interval_ratio_per_train", QT_TRANSLATE_NOOP("Profile", "Largest ratio of intervals"), "",
     QT_TRANSLATE_NOOP("Profile", "From one train to the next; 0: no limit.")},
};
struct ChoiceField {
    const char* key;
    const char* label;
    std::initializer_list<std::pair<const char*, const char*>> choices;
};
const ChoiceField kChoices[] = {
    {"assignment",
     QT_TRANSLATE_NOOP("Profile", "Assignment"),
     {{"texture_to_amplitude", QT_TRANSLATE_NOOP("Profile", "texture → amplitude, pressure → interval")},
      {"swapped", QT_TRANSLATE_NOOP("Profile", "pressure → amplitude, texture → interval")}}},
    {"amplitude_curve",
     QT_TRANSLATE_NOOP("Profile", "Curve of the amplitude"),
     {{"linear", QT_TRANSLATE_NOOP("Profile", "linear")},
      {"logarithmic", QT_TRANSLATE_NOOP("Profile", "logarithmic")},
      {"power", QT_TRANSLATE_NOOP("Profile", "power")}}},
    {"interval_curve",
     QT_TRANSLATE_NOOP("Profile", "Curve of the interval"),
     {{"linear", QT_TRANSLATE_NOOP("Profile", "linear")},
      {"logarithmic", QT_TRANSLATE_NOOP("Profile", "logarithmic")},
      {"power", QT_TRANSLATE_NOOP("Profile", "power")}}},
    {"shape",
     QT_TRANSLATE_NOOP("Profile", "Pulse shape"),
     {{"symmetric", QT_TRANSLATE_NOOP("Profile", "biphasic, symmetric")},
      {"asymmetric", QT_TRANSLATE_NOOP("Profile", "biphasic, asymmetric")},
      {"monophasic", QT_TRANSLATE_NOOP("Profile", "monophasic (bench loads only)")}}},
    {"polarity",
     QT_TRANSLATE_NOOP("Profile", "Leading phase"),
     {{"positive", QT_TRANSLATE_NOOP("Profile", "positive")}, {"negative", QT_TRANSLATE_NOOP("Profile", "negative")}}},
};

QString words(const char* text) { return QCoreApplication::translate("Profile", text); }

}  // namespace

ProfileEditor::ProfileEditor(BenchDesk& desk, QWidget* parent) : QDialog(parent), desk_(desk) {
    setWindowTitle(tr("Encoding profile"));
    setAttribute(Qt::WA_DeleteOnClose);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(explanation(tr("How roughness R and pressure P become pulse trains. It can be changed while the "
                                     "output is disarmed; the limits hold whatever stands here."),
                                  this));
    auto* row = new QHBoxLayout;
    auto* area = new QScrollArea(this);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* form = buildForm();
    area->setWidget(form);
    area->setMinimumWidth(form->minimumSizeHint().width() + fontMetrics().averageCharWidth() * 6);
    row->addWidget(area);
    auto* right = new QVBoxLayout;
    preview_ = new ProfilePreview(this);
    right->addWidget(preview_, 1);
    facts_ = new QLabel(this);
    facts_->setWordWrap(true);
    right->addWidget(facts_);
    row->addLayout(right, 1);
    layout->addLayout(row, 1);
    trouble_ = new QLabel(this);
    trouble_->setObjectName("profileTrouble");
    trouble_->setWordWrap(true);
    auto red = trouble_->palette();
    red.setColor(QPalette::WindowText, colours().fault);
    trouble_->setPalette(red);
    layout->addWidget(trouble_);
    layout->addWidget(buildButtons());
    fill(desk_.profile());
}

QWidget* ProfileEditor::buildForm() {
    auto* holder = new QWidget;
    auto* form = new QFormLayout(holder);
    for (const auto& field : kChoices) {
        auto* box = new QComboBox(holder);
        box->setObjectName(field.key);
        for (const auto& [key, text] : field.choices) box->addItem(words(text), key);
        connect(box, &QComboBox::currentIndexChanged, this, &ProfileEditor::judge);
        form->addRow(words(field.label), box);
        choices_.emplace_back(field.key, box);
    }
    for (const auto& field : kNumbers) {
        auto* line = new QLineEdit(holder);
        line->setObjectName(field.key);
        line->setToolTip(words(field.tip));
        line->setAlignment(Qt::AlignRight);
        connect(line, &QLineEdit::textChanged, this, &ProfileEditor::judge);
        const QString unit = field.unit;
        form->addRow(unit.isEmpty() ? words(field.label) : QString("%1 (%2)").arg(words(field.label), unit), line);
        numbers_.emplace_back(field.key, line);
    }
    return holder;
}

QWidget* ProfileEditor::buildButtons() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
    const auto button = [&](const QString& text, const QString& tip, auto slot) {
        auto* made = new QPushButton(text, holder);
        made->setToolTip(tip);
        made->setAutoDefault(false);
        connect(made, &QPushButton::clicked, this, slot);
        row->addWidget(made);
        return made;
    };
    button(tr("&Open…"), tr("A profile file (JSON)."), &ProfileEditor::load);
    save_ = button(tr("&Save…"), tr("Writes this profile to a file (JSON)."), &ProfileEditor::save);
    button(tr("S&hipped values"), tr("The paper's: 10 to 40 V, 2 s to 0.5 s."), [this] {
        if (const auto shipped = shippedProfile()) fill(*shipped);
    });
    row->addStretch();
    button(tr("&Close"), tr("Leaves the bench as it is."), &QDialog::reject);
    apply_ = button(tr("&Apply"), tr("From the next train on."), &ProfileEditor::apply);
    return holder;
}

void ProfileEditor::fill(const Profile& profile) {
    profile_ = profile;
    const auto section = toJson(profile.encoding);
    for (auto& [key, box] : choices_) {
        const QSignalBlocker quiet(box);
        box->setCurrentIndex(box->findData(QString::fromStdString(section.value(key, std::string()))));
    }
    for (auto& [key, line] : numbers_) {
        const QSignalBlocker quiet(line);
        const auto value = section.find(key);
        line->setText(value == section.end() ? QString() : QString::number(value->get<double>(), 'g', 10));
    }
    judge();
}

Result<Profile> ProfileEditor::read() const {
    auto section = toJson(profile_.encoding);
    for (const auto& [key, box] : choices_) section[key] = box->currentData().toString().toStdString();
    for (const auto& [key, line] : numbers_) {
        const auto text = line->text().trimmed().toStdString();
        const auto value = parseNumber(text);
        if (!value) return fail(ErrorCode::InvalidArgument, "{} is \"{}\"; a number is expected", key, text);
        if (key == "pulses" && *value == std::floor(*value))
            section[key] = static_cast<long long>(*value);
        else
            section[key] = *value;
    }
    auto encoding = encodingProfileFrom(section);
    if (!encoding) return failure(encoding);
    Profile profile = profile_;
    profile.encoding = std::move(*encoding);
    return profile;
}

void ProfileEditor::judge() {
    const auto profile = read();
    trouble_->setText(profile ? QString() : QString::fromStdString(profile.error().message));
    trouble_->setVisible(!profile);
    apply_->setEnabled(profile.has_value());
    save_->setEnabled(profile.has_value());
    if (!profile) return;
    preview_->show(profile->encoding);
    facts_->setText(preview_->facts());
}

void ProfileEditor::apply() {
    if (const auto profile = read()) desk_.setProfile(*profile);
}

void ProfileEditor::load() {
    auto* dialog = new QFileDialog(this, tr("Open a profile"), QString(), tr("Profiles (*.json)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
        const auto profile = loadProfile(path.toStdString());
        if (profile) return fill(*profile);
        trouble_->setText(QString::fromStdString(profile.error().message));
        trouble_->show();
    });
    dialog->open();
}

void ProfileEditor::save() {
    auto* dialog = new QFileDialog(this, tr("Save the profile"), "profile.json", tr("Profiles (*.json)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
        const auto profile = read();
        if (!profile) return;
        QSaveFile file(path);
        const auto text = QByteArray::fromStdString(toJson(*profile).dump(2) + "\n");
        if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit()) return;
        trouble_->setText(tr("%1 was not written: %2. The old file is as it was.").arg(path, file.errorString()));
        trouble_->show();
    });
    dialog->open();
}

}  // namespace tacto::gui
