#include "app/gui/live/ProfileEditor.h"

#include <QFile>
#include <cmath>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Theme.h"
#include "app/report/WholeFile.h"
#include "core/base/JsonText.h"
#include "core/base/Text.h"

namespace tacto::gui {

namespace {

const std::string kSource = "profile";

/// The core's sentence without the name of its source, which here is always the form.
QString refusalOf(const Error& error) {
    auto text = QString::fromStdString(error.message);
    const auto prefix = QString::fromStdString(kSource + ": ");
    return text.startsWith(prefix) ? text.mid(prefix.size()) : text;
}

}  // namespace

void ProfileEditor::fill(const Profile& profile) {
    filling_ = true;
    document_ = toJson(profile);
    name_->setText(QString::fromStdString(profile.name));
    for (auto& row : rows_) {
        const auto& value = document_[row.field->section()][row.field->key];
        if (row.box != nullptr)
            row.box->setCurrentIndex(row.box->findData(QString::fromStdString(value.get<std::string>())));
        else
            row.line->setText(value.is_number()
                                  ? QString::number(value.get<double>(), 'g', QLocale::FloatingPointShortest)
                                  : QString());
    }
    filling_ = false;
    judge();
}

ProfileEditor::Read ProfileEditor::read() const {
    auto document = document_;
    document["name"] = name_->text().trimmed().toStdString();
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
            return {{}, tr("\"%1\" is not a number; %2 is expected").arg(text, row.field->range()), row.field};
        value = *number;
    }
    auto profile = parseProfile(dumpJson(document), kSource);
    if (profile) return {std::move(*profile), {}, nullptr};
    const auto refusal = refusalOf(profile.error());
    return {{}, refusal, fieldIn(refusal)};
}

void ProfileEditor::judge() {
    if (filling_) return;
    const auto now = read();
    trouble_ = now.refusal;
    mark(now);
    enableWhatMatters();
    save_->setEnabled(now.profile.has_value());
    if (!now.profile) {
        apply_->setEnabled(false);
        return say(tr("Not to be applied: %1").arg(now.refusal), true);
    }
    const bool same = toJson(*now.profile) == toJson(controller_.profile());
    apply_->setEnabled(!same);
    say(same ? tr("In force.") : tr("Changed, not applied yet."), false);
    preview_->show(now.profile->encoding, now.profile->loadLow);
    facts_->setText(preview_->facts());
}

void ProfileEditor::mark(const Read& now) {
    for (auto& row : rows_) {
        const bool wrong = now.where == row.field;
        row.refusal->setText(wrong ? "⚠ " + now.refusal : QString());
        row.refusal->setVisible(wrong);
        auto amber = palette();
        amber.setColor(QPalette::WindowText, colours().amberText);
        row.refusal->setPalette(amber);
    }
    for (int tab = 0; tab < kProfileTabs; ++tab) {
        const bool wrong = now.where != nullptr && now.where->tab == static_cast<ProfileTab>(tab);
        tabs_->setTabText(tab, titleOf(static_cast<ProfileTab>(tab)) + (wrong ? " ⚠" : ""));
    }
}

void ProfileEditor::enableWhatMatters() {
    for (auto& row : rows_) {
        if (row.field->form.needs == nullptr) continue;
        const auto chosen = findChild<QComboBox*>(row.field->form.needs)->currentData().toString();
        QString needed = row.field->form.needsValue;
        const bool matters = needed.startsWith('!') ? chosen != needed.mid(1) : chosen == needed;
        // One that is refused can always be mended.
        row.line->setEnabled(matters || !row.refusal->text().isEmpty());
        row.label->setEnabled(row.line->isEnabled());
    }
}

void ProfileEditor::say(const QString& text, bool wrong) {
    says_->setText(wrong ? "⚠ " + text : text);
    auto colour = palette();
    if (wrong) colour.setColor(QPalette::WindowText, colours().amberText);
    says_->setPalette(colour);
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
    const auto written = writeWholeFile(path, QByteArray::fromStdString(dumpJson(toJson(*now.profile), 2) + "\n"));
    if (written) return say(tr("Saved to %1.").arg(path), false);
    say(tr("%1 was not written: %2. The previous file is unchanged.")
            .arg(path, QString::fromStdString(written.error().message)),
        true);
}

void ProfileEditor::chooseFile() {
    FileQuestion question;
    question.title = tr("Open a profile");
    question.filters << tr("Profiles (*.json)");
    askForFile(*this, question, [this](const QString& path) { openFile(path); });
}

void ProfileEditor::chooseTarget() {
    FileQuestion question;
    question.title = tr("Save the profile");
    question.wants = FileQuestion::Wants::NewFile;
    question.filters << tr("Profiles (*.json)");
    question.suffix = "json";
    question.name = name_->text().trimmed() + ".json";
    askForFile(*this, question, [this](const QString& path) { saveFile(path); });
}

}  // namespace tacto::gui

#include "moc_ProfileEditor.cpp"
