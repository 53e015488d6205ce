#include "app/gui/runner/ScriptEditor.h"

#include <QDir>
#include <QRegularExpression>

#include "app/gui/look/Dialogs.h"
#include "app/gui/look/Look.h"
#include "app/report/WholeFile.h"
#include "app/scripting/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

constexpr const char* kTemplate = R"js(// What this protocol finds out.
protocol({
  title: "My protocol",
  purpose: "What does it answer?",
  needs: ["stimulator", "oscilloscope"],
  parameters: {
    load: { label: "Load", unit: "ohm", min: 100, max: 1e5, value: 1000 },
  },
});

function run(p) {
  bench.arm({ load: p.load });
  bench.drive("manual", { roughness: 0.5, pressure: 0.5 });
  record.trial("middle", measure.train(bench.capture({ trains: 2 })));
  bench.disarm();
}
)js";

}  // namespace

void ScriptEditor::edit(const ProtocolSource& source) {
    const bool same = !source.text.empty() && source.path == source_.path && source.name == source_.name;
    if (isVisible() && code_->document()->isModified()) {
        if (!same) message_->setText(tr("⚠ This script has changes that are not saved. Save it or close it first."));
        raise();
        activateWindow();
        return;
    }
    source_ = source;
    const bool isNew = source.text.empty();
    code_->setPlainText(isNew ? QString(kTemplate) : QString::fromStdString(source.text));
    code_->document()->setModified(false);
    code_->setReadOnly(source.shipped);
    code_->mark(0);
    later_.stop();
    naming_->hide();
    leaving_->hide();
    runWhenSaved_ = leaveWhenSaved_ = false;
    message_->setText(source.shipped
                          ? tr("This protocol comes with the program and cannot be changed here. Save a copy "
                               "to make it the lab's own.")
                      : isNew ? tr("A template to begin with. Save it under a name of its own.")
                              : QString::fromStdString(source.path.string()));
    showTitle();
    if (!isVisible()) place(*this);
    show();
    raise();
    activateWindow();
    code_->setFocus();
}

void ScriptEditor::showTitle() {
    const auto name = source_.name.empty() ? tr("new") : QString::fromStdString(source_.name);
    setWindowTitle(source_.shipped ? tr("Protocol script: %1 (read-only)").arg(name)
                                   : tr("Protocol script: %1[*]").arg(name));
    setWindowModified(code_->document()->isModified());
    save_->setText(source_.shipped || source_.path.empty() ? tr("&Save a copy…") : tr("&Save"));
}

void ScriptEditor::showError(int line, const QString& why) {
    code_->mark(line);
    message_->setText("⚠ " + why);
}

void ScriptEditor::check() {
    ProtocolSource source = source_;
    source.text = code_->toPlainText().toStdString();
    if (source.name.empty()) source.name = "script";
    reading_.read(source);
}

void ScriptEditor::checked(const Result<ProtocolDeclaration>& declaration) {
    if (declaration) {
        code_->mark(0);
        message_->setText(
            tr("✔ \"%1\" declares %n parameter(s) and reads well.", nullptr, int(declaration->parameters.size()))
                .arg(QString::fromStdString(declaration->title)));
        return;
    }
    const auto why = QString::fromStdString(declaration.error().message);
    // The user may be typing: the mark comes, the cursor stays.
    const auto cursor = code_->textCursor();
    showError(lineOf(why), why);
    if (code_->hasFocus()) code_->setTextCursor(cursor);
}

void ScriptEditor::save() {
    if (!source_.shipped && !source_.path.empty()) return saveTo(QString::fromStdString(source_.path.string()));
    name_->setText(source_.name.empty() ? "my-protocol" : "my-" + QString::fromStdString(source_.name));
    naming_->show();
    leaving_->hide();
    name_->setFocus();
    name_->selectAll();
}

void ScriptEditor::saveAs(const QString& name) {
    static const QRegularExpression fitting("^[A-Za-z0-9_-]+$");
    if (!fitting.match(name).hasMatch())
        return message_->setText(
            tr("⚠ \"%1\" is no name for a protocol: letters, digits, - and _ are expected.").arg(name));
    const auto path = QString::fromStdString((userProtocolsFolder() / (name.toStdString() + ".js")).string());
    if (QFileInfo::exists(path))
        return message_->setText(
            tr("⚠ The lab has a protocol %1 already. Choose another name, or edit that one.").arg(name));
    saveTo(path);
}

void ScriptEditor::saveTo(const QString& path) {
    QDir().mkpath(QFileInfo(path).absolutePath());
    const auto text = code_->toPlainText().toUtf8();
    if (const auto written = writeWholeFile(path, text); !written) {
        runWhenSaved_ = leaveWhenSaved_ = false;
        return message_->setText(tr("⚠ Not saved: %1: %2. The text is still here.")
                                     .arg(path, QString::fromStdString(written.error().message)));
    }
    source_.path = path.toStdString();
    source_.name = QFileInfo(path).completeBaseName().toStdString();
    source_.text = text.toStdString();
    source_.shipped = false;
    naming_->hide();
    code_->setReadOnly(false);
    code_->document()->setModified(false);
    showTitle();
    message_->setText(tr("Saved to %1.").arg(path));
    emit saved(path);
    check();
    if (std::exchange(runWhenSaved_, false)) emit runRequested(path);
    if (std::exchange(leaveWhenSaved_, false)) leave();
}

void ScriptEditor::reject() {
    if (!code_->document()->isModified()) return leave();
    leaving_->show();
    if (auto* first = leaving_->findChild<QPushButton*>()) first->setFocus();
}

void ScriptEditor::leave() {
    code_->document()->setModified(false);
    later_.stop();
    QDialog::reject();
}

}  // namespace tacto::gui
