#include "app/gui/live/ProfileEditor.h"

#include <QScreen>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/run/Shipped.h"
#include "core/base/JsonText.h"
#include "core/base/WholeFile.h"

namespace tacto::gui {

namespace {

constexpr int kPollInterval_ms = 100;
const std::string kSource = "profile";

/// Returns the core's message without the name of its source, which is always the form here.
QString refusalOf(const Error& error) {
    auto text = QString::fromStdString(error.message);
    const auto prefix = QString::fromStdString(kSource + ": ");
    return text.startsWith(prefix) ? text.mid(prefix.size()) : text;
}

}  // namespace

ProfileEditor::ProfileEditor(BenchController& controller, QWidget* parent) : QDialog(parent), controller_(controller) {
    setWindowTitle(tr("Encoding profile"));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(
        explanation(tr("How touch becomes pulse trains. Change the encoding while the output is disarmed; "
                       "the limits always apply."),
                    this));
    auto* split = new QHBoxLayout;
    auto* left = new QVBoxLayout;
    auto* naming = new QHBoxLayout;
    auto* nameLabel = new QLabel(tr("&Name"), this);
    name_ = new QLineEdit(this);
    name_->setToolTip(tr("Appears in reports and session files."));
    nameLabel->setBuddy(name_);
    connect(name_, &QLineEdit::textChanged, this, &ProfileEditor::judge);
    naming->addWidget(nameLabel);
    naming->addWidget(name_, 1);
    left->addLayout(naming);
    tabs_ = new ProfileTabs(this);
    connect(tabs_, &ProfileTabs::edited, this, &ProfileEditor::judge);
    left->addWidget(tabs_, 1);
    split->addLayout(left);
    auto* right = new QVBoxLayout;
    preview_ = new ProfilePreview(this);
    right->addWidget(preview_, 1);
    facts_ = makeLabel({}, {.name = "profileFacts", .wraps = true}, this);
    facts_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    facts_->setMinimumHeight(fontMetrics().height() * 4);
    right->addWidget(facts_);
    split->addLayout(right, 1);
    layout->addLayout(split, 1);
    says_ = makeLabel({}, {.name = "profileTrouble", .wraps = true}, this);
    layout->addWidget(says_);
    layout->addWidget(buildButtons());
    fill(controller_.profile());
    connect(&controller_, &BenchController::changed, this, [this] {
        applying_ = false;
        judge();
    });
    connect(&controller_, &BenchController::failed, this, [this](const QString& what) {
        if (std::exchange(applying_, false)) say(tr("Not applied: %1").arg(what), true);
    });
    connect(&look_, &QTimer::timeout, this, [this] {
        const auto telemetry = controller_.telemetry();
        preview_->setPoint(telemetry.roughness, telemetry.pressure);
        preview_->setImpedance(telemetry.impedance_ohm);
        facts_->setText(preview_->facts());
    });
    look_.start(kPollInterval_ms);
    tabs_->setFocus();
    const auto room = screen()->availableSize() * 0.9;
    resize(QSize(fontMetrics().averageCharWidth() * 135, fontMetrics().height() * 40).boundedTo(room));
}

void ProfileEditor::goTo(const QString& key) { tabs_->goTo(key); }

QWidget* ProfileEditor::buildButtons() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    const auto button = [&](const QString& text, const QString& tip, auto slot) {
        auto* made = pageButton(text, {}, tip, holder);
        connect(made, &QPushButton::clicked, this, slot);
        row->addWidget(made);
        return made;
    };
    button(tr("&Open…"), tr("Loads a profile from a file (JSON) into this form."), &ProfileEditor::chooseFile);
    save_ = button(tr("&Save…"), tr("This form into a file (JSON)."), &ProfileEditor::chooseTarget);
    button(tr("S&hipped values"), tr("Fills this form with the values that come with the program."), [this] {
        if (const auto shipped = shippedProfile())
            fill(*shipped);
        else
            say(QString::fromStdString(shipped.error().message), true);
    });
    row->addStretch();
    button(tr("&Close"), tr("Leaves the bench as it is."), &QDialog::reject);
    apply_ = button(tr("&Apply"), tr("In force from the next train on."), &ProfileEditor::apply);
    return holder;
}

void ProfileEditor::fill(const Profile& profile) {
    filling_ = true;
    document_ = toJson(profile);
    name_->setText(QString::fromStdString(profile.name));
    tabs_->fill(document_);
    filling_ = false;
    judge();
}

ProfileEditor::Read ProfileEditor::read() const {
    auto document = document_;
    document["name"] = name_->text().trimmed().toStdString();
    if (const auto refused = tabs_->read(document)) return {{}, refused->text, refused->field};
    auto profile = parseProfile(dumpJson(document), kSource);
    if (profile) return {std::move(*profile), {}, nullptr};
    const auto refusal = refusalOf(profile.error());
    return {{}, refusal, fieldIn(refusal)};
}

void ProfileEditor::judge() {
    if (filling_) return;
    const auto now = read();
    trouble_ = now.refusal;
    const auto words = inFormWords(now.refusal);
    tabs_->mark(now.where, words);
    save_->setEnabled(now.profile.has_value());
    if (!now.profile) {
        apply_->setEnabled(false);
        return say(tr("Cannot be applied: %1").arg(words), true);
    }
    const bool same = toJson(*now.profile) == toJson(controller_.profile());
    apply_->setEnabled(!same);
    say(same ? tr("In force.") : tr("Changed, not applied yet."), false);
    preview_->show(now.profile->encoding, now.profile->loadLow);
    facts_->setText(preview_->facts());
}

void ProfileEditor::say(const QString& text, bool wrong) {
    says_->setText(wrong ? "⚠ " + text : text);
    setTone(*says_, wrong ? Tone::Warning : Tone::Text);
}

void ProfileEditor::apply() {
    const auto now = read();
    if (!now.profile) return;
    applying_ = true;
    controller_.setProfile(*now.profile);
}

void ProfileEditor::openFile(const QString& path) {
    const auto profile = loadProfile(path.toStdString());
    if (profile) return fill(*profile);
    say(tr("Not opened: %1").arg(QString::fromStdString(profile.error().message)), true);
}

void ProfileEditor::saveFile(const QString& path) {
    const auto now = read();
    if (!now.profile) return;
    const auto written = writeWholeFile(path.toStdString(), dumpJson(toJson(*now.profile), 2) + "\n");
    if (written) return say(tr("Saved to %1.").arg(path), false);
    say(tr("%1 was not written: %2. The previous file is unchanged.")
            .arg(path, QString::fromStdString(written.error().message)),
        true);
}

void ProfileEditor::chooseFile() {
    FileQuestion question{.title = tr("Open a profile"), .filters = {tr("Profiles (*.json)")}};
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void ProfileEditor::chooseTarget() {
    FileQuestion question{.title = tr("Save the profile"),
                          .wants = FileQuestion::Wants::NewFile,
                          .filters = {tr("Profiles (*.json)")},
                          .name = name_->text().trimmed() + ".json",
                          .suffix = "json"};
    askForFile(*this, question, [this](const QString& path) { saveFile(path); });
}

}  // namespace tacto::gui

#include "moc_ProfileEditor.cpp"
