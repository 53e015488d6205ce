#include "app/gui/runner/ScriptEditor.h"

#include <QDir>
#include <QHBoxLayout>
#include <QInputDialog>
#include <QPointer>
#include <QRegularExpression>
#include <QSaveFile>
#include <QSplitter>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <thread>

#include "app/gui/look/Look.h"
#include "app/scripting/ProtocolLibrary.h"
#include "app/scripting/ScriptRun.h"

namespace tacto::gui {

namespace {

constexpr int kCheckAfter_ms = 600;

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

ScriptEditor::ScriptEditor(QWidget* parent) : QDialog(parent) {
    setWindowTitle(tr("Protocol script"));
    auto* layout = new QVBoxLayout(this);
    auto* split = new QSplitter(Qt::Horizontal, this);
    code_ = new CodeEdit(split);
    code_->setAccessibleName(tr("Script"));
    auto* reference = new QTextBrowser(split);
    reference->setAccessibleName(tr("Reference of the host objects"));
    reference->setMarkdown(QString::fromStdString(scriptReference()));
    split->addWidget(code_);
    split->addWidget(reference);
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    layout->addWidget(split, 1);
    message_ = new QLabel(this);
    message_->setObjectName("scriptMessage");
    message_->setWordWrap(true);
    message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(message_);
    auto* row = new QHBoxLayout;
    const auto button = [&](const QString& text, const QString& tip, auto slot) {
        auto* made = new QPushButton(text, this);
        made->setToolTip(tip);
        made->setAutoDefault(false);
        connect(made, &QPushButton::clicked, this, slot);
        row->addWidget(made);
        return made;
    };
    button(tr("&Check"), tr("Reads what the script declares. Nothing is delivered."), &ScriptEditor::check);
    save_ = button(tr("&Save"), tr("Into the lab's own protocols."), &ScriptEditor::save);
    row->addStretch();
    run_ = button(tr("Save and &open to run"), tr("Saves, and shows its form in the workspace."), &ScriptEditor::run);
    button(tr("C&lose"), tr("Closes the editor; unsaved changes are lost."), &QDialog::reject);
    layout->addLayout(row);
    later_.setSingleShot(true);
    connect(&later_, &QTimer::timeout, this, &ScriptEditor::check);
    connect(code_, &QPlainTextEdit::textChanged, this, [this] { later_.start(kCheckAfter_ms); });
    resize(fontMetrics().averageCharWidth() * 150, fontMetrics().height() * 42);
}

void ScriptEditor::show(const ProtocolSource& source) {
    source_ = source;
    const bool isNew = source.text.empty();
    code_->setPlainText(isNew ? QString(kTemplate) : QString::fromStdString(source.text));
    code_->setReadOnly(source.shipped);
    code_->mark(0);
    save_->setText(source.shipped || isNew ? tr("&Save a copy…") : tr("&Save"));
    setWindowTitle(isNew ? tr("New protocol script")
                         : tr("Protocol script: %1").arg(QString::fromStdString(source.name)));
    message_->setText(source.shipped
                          ? tr("This protocol comes with the program and cannot be changed here. Save a copy "
                               "to make it the lab's own.")
                          : QString());
    if (source.shipped) later_.stop();
    QDialog::show();
    raise();
}

void ScriptEditor::showError(int line, const QString& why) {
    code_->mark(line);
    message_->setText(why);
}

void ScriptEditor::check() {
    ProtocolSource source = source_;
    source.text = code_->toPlainText().toStdString();
    if (source.name.empty()) source.name = "script";
    // The script's top level runs for up to a second: not on this thread. Only the newest answer counts.
    const int number = ++*asked_;
    std::thread([source = std::move(source), number, asked = asked_, editor = QPointer<ScriptEditor>(this)] {
        auto declaration = readDeclaration(source);
        QMetaObject::invokeMethod(
            qApp,
            [declaration = std::move(declaration), number, asked, editor] {
                if (editor && *asked == number) editor->checked(declaration);
            },
            Qt::QueuedConnection);
    }).detach();
}

void ScriptEditor::checked(const Result<ProtocolDeclaration>& declaration) {
    if (declaration) {
        code_->mark(0);
        message_->setText(
            tr("\"%1\" declares %n parameter(s) and reads well.", nullptr, int(declaration->parameters.size()))
                .arg(QString::fromStdString(declaration->title)));
        return;
    }
    const auto why = QString::fromStdString(declaration.error().message);
    static const QRegularExpression place(R"(:(\d+):)");
    const auto match = place.match(why);
    showError(match.hasMatch() ? match.captured(1).toInt() : 0, why);
}

void ScriptEditor::save() {
    if (!source_.shipped && !source_.path.empty()) return saveTo(QString::fromStdString(source_.path.string()));
    auto* dialog = new QInputDialog(this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr("Save a copy"));
    dialog->setLabelText(tr("Name of the protocol (letters, digits, - and _)"));
    dialog->setTextValue(source_.name.empty() ? "my-protocol" : "my-" + QString::fromStdString(source_.name));
    connect(dialog, &QInputDialog::textValueSelected, this, [this](const QString& name) {
        static const QRegularExpression fitting("^[A-Za-z0-9_-]+$");
        if (!fitting.match(name).hasMatch()) {
            message_->setText(tr("\"%1\" is no name for a protocol; letters, digits, - and _ are expected.").arg(name));
            return;
        }
        saveTo(QString::fromStdString((userProtocolsFolder() / (name.toStdString() + ".js")).string()));
    });
    connect(dialog, &QDialog::rejected, this, [this] { runWhenSaved_ = false; });
    dialog->open();
}

void ScriptEditor::saveTo(const QString& path) {
    QDir().mkpath(QFileInfo(path).absolutePath());
    QSaveFile file(path);
    const auto text = code_->toPlainText().toUtf8();
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size() || !file.commit()) {
        message_->setText(tr("%1 was not saved: %2.").arg(path, file.errorString()));
        return;
    }
    source_.path = path.toStdString();
    source_.name = QFileInfo(path).baseName().toStdString();
    source_.shipped = false;
    code_->setReadOnly(false);
    save_->setText(tr("&Save"));
    setWindowTitle(tr("Protocol script: %1").arg(QFileInfo(path).baseName()));
    message_->setText(tr("Saved to %1.").arg(path));
    emit saved(path);
    if (std::exchange(runWhenSaved_, false)) emit runRequested(path);
}

void ScriptEditor::run() {
    runWhenSaved_ = true;
    save();
}

}  // namespace tacto::gui
