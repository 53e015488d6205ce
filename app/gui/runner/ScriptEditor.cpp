#include "app/gui/runner/ScriptEditor.h"

#include <QDir>
#include <QKeyEvent>
#include <QRegularExpression>
#include <QShortcut>
#include <QSplitter>
#include <QTextBrowser>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Theme.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/base/WholeFile.h"
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

constexpr int kCheckAfter_ms = 600;  // time since the last key press
constexpr int kUpdateDelay_ms = 100;

}  // namespace

ScriptEditor::ScriptEditor(const BenchController& controller, QWidget* parent)
    : QDialog(parent),
      controller_(controller),
      reading_([this](const auto&, const auto& declaration) { checked(declaration); }) {
    setObjectName("scriptEditor");
    setWindowFlag(Qt::WindowMinMaxButtonsHint);
    setSizeGripEnabled(true);
    auto* layout = new QVBoxLayout(this);
    auto* split = new QSplitter(Qt::Horizontal, this);
    split->setChildrenCollapsible(false);
    auto* text = new QWidget(split);
    auto* column = columnIn(*text);
    code_ = new CodeEdit(text);
    code_->setAccessibleName(tr("Script"));
    find_ = new FindBar(*code_, text);
    column->addWidget(find_);
    column->addWidget(code_, 1);
    auto* reference = new QTextBrowser(split);
    reference->setAccessibleName(tr("Reference of the host objects"));
    reference->setMarkdown(QString::fromStdString(scriptReference()));
    addAll(*split, {text, reference});
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    layout->addWidget(split, 1);
    message_ = makeLabel({}, {.name = "scriptMessage", .wraps = true, .plain = true, .selectable = true}, this);
    layout->addWidget(message_);
    naming_ = buildNaming();
    leaving_ = buildLeaving();
    addAll(*layout, {naming_, leaving_});
    buildButtons();
    later_.setSingleShot(true);
    later_.setInterval(kCheckAfter_ms);
    connect(&later_, &QTimer::timeout, this, &ScriptEditor::check);
    connect(code_, &CodeEdit::textChanged, this, [this] {
        if (code_->isModified()) later_.start();
    });
    connect(code_, &CodeEdit::modificationChanged, this, &QWidget::setWindowModified);
    resize(fontMetrics().averageCharWidth() * 150, fontMetrics().height() * 42);
}

QWidget* ScriptEditor::buildNaming() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    name_ = new QLineEdit(holder);
    name_->setObjectName("protocolName");
    name_->setToolTip(tr("Letters, digits, - and _. The name of a shipped protocol takes that one's place."));
    auto* label = new QLabel(tr("Save as &protocol"), holder);
    label->setBuddy(name_);
    auto* save = new QPushButton(tr("Sa&ve as"), holder);
    save->setToolTip(tr("Writes it into the lab's own protocols."));
    auto* back = new QPushButton(tr("Do not save"), holder);
    back->setToolTip(tr("Back to the text."));
    row->addWidget(label);
    row->addWidget(name_, 1);
    addAll(*row, {save, back});
    connect(name_, &QLineEdit::returnPressed, this, [this] { saveAs(name_->text().trimmed()); });
    connect(save, &QPushButton::clicked, this, [this] { saveAs(name_->text().trimmed()); });
    connect(back, &QPushButton::clicked, this, [this] {
        stay();
        naming_->hide();
        code_->setFocus();
    });
    for (auto* button : {save, back}) button->setAutoDefault(false);
    holder->hide();
    return holder;
}

QWidget* ScriptEditor::buildLeaving() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    row->addWidget(new QLabel(tr("⚠ There are changes that are not saved."), holder), 1);
    const auto add = [&](const QString& text, const QString& tip, auto act) {
        auto* button = pageButton(text, {}, tip, holder);
        connect(button, &QPushButton::clicked, this, act);
        row->addWidget(button);
    };
    add(tr("&Keep editing"), tr("Back to the text."), [this] {
        stay();
        leaving_->hide();
        code_->setFocus();
    });
    add(tr("Save and close"), tr("Into the lab's own protocols."), [this] { saveAndLeave(); });
    add(tr("&Discard the changes"), tr("What was saved before stays as it is."), [this] {
        leaving_->hide();
        leave();
    });
    holder->hide();
    return holder;
}

void ScriptEditor::buildButtons() {
    auto* row = new QHBoxLayout;
    const auto button = [&](const QString& text, const QString& tip, auto slot) {
        auto* made = pageButton(text, {}, tip, this);
        connect(made, &QPushButton::clicked, this, slot);
        row->addWidget(made);
        return made;
    };
    const auto saveAndRun = [this] {
        runWhenSaved_ = !source_.shipped;
        if (runWhenSaved_ && !source_.path.empty() && !code_->isModified()) {
            runWhenSaved_ = false;
            emit runRequested(QString::fromStdString(source_.path.string()));
        } else {
            save();
        }
    };
    button(tr("&Check"), tr("Reads what the script declares. Nothing is delivered."), &ScriptEditor::check);
    save_ = button(tr("&Save"), tr("Into the lab's own protocols (Ctrl+S)."), &ScriptEditor::save);
    row->addStretch();
    button(tr("&Run…"), tr("Saves it and shows its settings in the workspace, where F5 runs it (F5)."), saveAndRun);
    button(tr("C&lose"), tr("Closes the editor. Asks first if there are unsaved changes."), &QDialog::reject);
    static_cast<QVBoxLayout*>(layout())->addLayout(row);
    connect(new QShortcut(QKeySequence::Save, this), &QShortcut::activated, this, &ScriptEditor::save);
    connect(new QShortcut(QKeySequence::Find, this), &QShortcut::activated, this, [this] {
        find_->begin();
        look();
        look_.start();
    });
    for (const bool forward : {true, false}) {
        const auto keys = forward ? QKeySequence::FindNext : QKeySequence::FindPrevious;
        connect(new QShortcut(keys, this), &QShortcut::activated, this, [this, forward] { find_->go(forward); });
    }
    look_.setInterval(kUpdateDelay_ms);
    connect(&look_, &QTimer::timeout, this, &ScriptEditor::look);
    connect(new QShortcut(QKeySequence(Qt::Key_F5), this), &QShortcut::activated, this, saveAndRun);
}

void ScriptEditor::edit(const ProtocolSource& source) {
    const bool same = !source.text.empty() && source.path == source_.path && source.name == source_.name;
    if (isVisible() && code_->isModified()) {
        if (!same) message_->setText(tr("⚠ This script has changes that are not saved. Save it or close it first."));
        raise();
        activateWindow();
        return;
    }
    source_ = source;
    const bool isNew = source.text.empty();
    code_->setText(isNew ? QString(kTemplate) : QString::fromStdString(source.text));
    code_->setModified(false);
    code_->setReadOnly(source.shipped);
    code_->mark(0);
    later_.stop();
    naming_->hide();
    leaving_->hide();
    stay();
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

QString ScriptEditor::scriptName() const {
    return source_.name.empty() ? tr("new") : QString::fromStdString(source_.name);
}

void ScriptEditor::showTitle() {
    setWindowTitle(source_.shipped ? tr("Protocol script: %1 (read-only)").arg(scriptName())
                                   : tr("Protocol script: %1[*]").arg(scriptName()));
    setWindowModified(code_->isModified());
    save_->setText(source_.shipped || source_.path.empty() ? tr("&Save a copy…") : tr("&Save"));
}

void ScriptEditor::showError(int line, const QString& why) {
    code_->mark(line);
    message_->setText("⚠ " + why);
}

void ScriptEditor::check() {
    ProtocolSource source = source_;
    source.text = code_->text().toStdString();
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
    code_->mark(lineOf(why), !code_->hasFocus());  // the cursor stays where the user may be typing
    message_->setText("⚠ " + why);
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
            tr("⚠ \"%1\" is not a name for a protocol: letters, digits, - and _ are expected.").arg(name));
    const auto path = QString::fromStdString((userProtocolsFolder() / (name.toStdString() + ".js")).string());
    if (QFileInfo::exists(path))
        return message_->setText(
            tr("⚠ The lab has a protocol %1 already. Choose another name, or edit that one.").arg(name));
    saveTo(path);
}

void ScriptEditor::saveTo(const QString& path) {
    QDir().mkpath(QFileInfo(path).absolutePath());
    const auto text = code_->text().toStdString();
    if (const auto written = writeWholeFile(path.toStdString(), text); !written) {
        stay();
        return message_->setText(tr("⚠ Not saved: %1: %2. The text is still here.")
                                     .arg(path, QString::fromStdString(written.error().message)));
    }
    source_.path = path.toStdString();
    source_.name = QFileInfo(path).completeBaseName().toStdString();
    source_.text = text;
    source_.shipped = false;
    naming_->hide();
    code_->setReadOnly(false);
    code_->setModified(false);
    showTitle();
    message_->setText(tr("Saved to %1.").arg(path));
    emit saved(path);
    check();
    if (std::exchange(runWhenSaved_, false)) emit runRequested(path);
    if (!std::exchange(leaveWhenSaved_, false)) return;
    const auto left = std::exchange(left_, {});
    leave();
    if (left) left();
}

void ScriptEditor::saveAndLeave(std::function<void()> then) {
    leaving_->hide();
    runWhenSaved_ = false;
    leaveWhenSaved_ = true;
    left_ = std::move(then);
    raise();
    activateWindow();
    save();
}

/// Forgets the action that was to follow saving.
void ScriptEditor::stay() {
    runWhenSaved_ = leaveWhenSaved_ = false;
    left_ = {};
}

void ScriptEditor::look() {
    const auto state = controller_.telemetry().state;
    wasLive_ =
        state != InterlockState::Disconnected && state != InterlockState::Disarmed && state != InterlockState::Faulted;
    if (!find_->isVisible()) look_.stop();
}

/// Esc stops the output, wherever the focus is. Esc closes the search only if there was nothing to stop, so that a stop
/// does not lose the operator's place in the text.
void ScriptEditor::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Escape || !find_->isVisible()) return QDialog::keyPressEvent(event);
    if (!std::exchange(wasLive_, false)) find_->close();
}

void ScriptEditor::reject() {
    if (!unsaved()) return leave();
    leaving_->show();
    if (auto* first = leaving_->findChild<QPushButton*>()) first->setFocus();
}

void ScriptEditor::leave() {
    stay();
    code_->setModified(false);
    naming_->hide();
    later_.stop();
    QDialog::reject();
}

void ScriptReading::read(const ProtocolSource& source) {
    if (busy_)
        next_ = source;
    else
        begin(source);
}

void ScriptReading::begin(const ProtocolSource& source) {
    busy_ = true;
    reading_.start(
        this, [source] { return readDeclaration(source); },
        [this, source](const Result<ProtocolDeclaration>& declaration) {
            busy_ = false;
            if (!next_) return done_(source, declaration);
            begin(*std::exchange(next_, std::nullopt));
        });
}

int lineOf(const QString& error) {
    static const QRegularExpression place(R"(:(\d+):)");
    const auto match = place.match(error);
    return match.hasMatch() ? match.captured(1).toInt() : 0;
}

}  // namespace tacto::gui

#include "moc_ScriptEditor.cpp"
