#include "app/gui/window/CloseQuestion.h"

#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

QMessageBox* question(const QString& text, QMessageBox::StandardButtons buttons, QWidget& window) {
    auto* box = new QMessageBox(QMessageBox::NoIcon, QObject::tr("Close Tactoscope?"), text, buttons, &window);
    box->setObjectName("closeQuestion");
    box->setEscapeButton(QMessageBox::Cancel);
    return box;
}

}  // namespace

CloseQuestion::CloseQuestion(BenchController& controller, QMainWindow& window, Runners runners,
                             std::function<bool()> otherRuns)
    : QObject(&window),
      controller_(controller),
      window_(window),
      runners_(std::move(runners)),
      otherRuns_(std::move(otherRuns)) {}

bool CloseQuestion::runs() const {
    return otherRuns_() || std::ranges::any_of(runners_(), [](const ProtocolWorkspace* one) { return one->running(); });
}

std::vector<ScriptEditor*> CloseQuestion::unsaved() const {
    std::vector<ScriptEditor*> found;
    for (const auto* runner : runners_()) {
        if (auto* editor = runner->unsavedScript()) found.push_back(editor);
    }
    return found;
}

bool CloseQuestion::mayClose(bool stopped) {
    if (unasked_) return true;
    if (stopped && !runAnswered_) {
        askAboutRun();
        return false;
    }
    if (unsaved().empty()) return true;
    askAboutScripts();
    return false;
}

void CloseQuestion::closeUnasked() {
    unasked_ = true;
    window_.close();
    unasked_ = false;
}

void CloseQuestion::askAboutRun() {
    auto* box = question(
        tr("The output was switched off. The run was stopped before its end; what it measured until then is kept in "
           "its session. Close the window?"),
        QMessageBox::Close | QMessageBox::Cancel, window_);
    box->button(QMessageBox::Close)->setText(tr("&Close the window"));
    box->button(QMessageBox::Cancel)->setText(tr("&Keep it open"));
    box->setDefaultButton(QMessageBox::Cancel);
    // Another bench or another run makes the question void.
    connect(&controller_, &BenchController::changed, box, [this, box] {
        if (controller_.activity() == Activity::Opening) box->reject();
    });
    connect(box, &QMessageBox::finished, this, [this](int answer) {
        if (answer != QMessageBox::Close) return;
        runAnswered_ = true;
        window_.close();
        runAnswered_ = false;
    });
    openDialog(box);
}

void CloseQuestion::askAboutScripts() {
    QStringList names;
    for (const auto* editor : unsaved()) names << editor->scriptName();
    auto* box =
        question(tr("The output was switched off. Not saved: %1 %2. Save before the window closes?")
                     .arg(names.size() == 1 ? tr("the protocol script") : tr("the protocol scripts"), names.join(", ")),
                 QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, window_);
    makePrimary(*qobject_cast<QPushButton*>(box->button(QMessageBox::Save)));
    box->setDefaultButton(QMessageBox::Save);
    connect(box, &QMessageBox::finished, this, [this](int answer) {
        if (answer == QMessageBox::Save) saveNext();
        if (answer == QMessageBox::Discard) discard();
    });
    openDialog(box);
}

/// Saves the scripts one by one, because each may need a file name from the user.
void CloseQuestion::saveNext() {
    const auto left = unsaved();
    if (left.empty()) {
        window_.close();
        return;
    }
    left.front()->saveAndLeave(
        [this] { QMetaObject::invokeMethod(this, &CloseQuestion::saveNext, Qt::QueuedConnection); });
}

void CloseQuestion::discard() {
    for (auto* editor : unsaved()) editor->leave();
    window_.close();
}

}  // namespace tacto::gui

#include "moc_CloseQuestion.cpp"
