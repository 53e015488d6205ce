// How ScriptEditor is put together.
#include <QHBoxLayout>
#include <QShortcut>
#include <QSplitter>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/scripting/ScriptRun.h"

namespace tacto::gui {

namespace {
constexpr int kCheckAfter_ms = 600;  // without a key press
}

ScriptEditor::ScriptEditor(QWidget* parent)
    : QDialog(parent), reading_([this](const auto&, const auto& declaration) { checked(declaration); }) {
    setObjectName("scriptEditor");
    setWindowFlag(Qt::WindowMinMaxButtonsHint);
    setSizeGripEnabled(true);
    auto* layout = new QVBoxLayout(this);
    auto* split = new QSplitter(Qt::Horizontal, this);
    split->setChildrenCollapsible(false);
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
    message_->setTextFormat(Qt::PlainText);
    message_->setObjectName("scriptMessage");
    message_->setWordWrap(true);
    message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(message_);
    naming_ = buildNaming();
    leaving_ = buildLeaving();
    layout->addWidget(naming_);
    layout->addWidget(leaving_);
    buildButtons();
    later_.setSingleShot(true);
    later_.setInterval(kCheckAfter_ms);
    connect(&later_, &QTimer::timeout, this, &ScriptEditor::check);
    connect(code_, &QPlainTextEdit::textChanged, this, [this] {
        if (code_->document()->isModified()) later_.start();
    });
    connect(code_->document(), &QTextDocument::modificationChanged, this, &QWidget::setWindowModified);
    resize(fontMetrics().averageCharWidth() * 150, fontMetrics().height() * 42);
}

QWidget* ScriptEditor::buildNaming() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
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
    row->addWidget(save);
    row->addWidget(back);
    connect(name_, &QLineEdit::returnPressed, this, [this] { saveAs(name_->text().trimmed()); });
    connect(save, &QPushButton::clicked, this, [this] { saveAs(name_->text().trimmed()); });
    connect(back, &QPushButton::clicked, this, [this] {
        runWhenSaved_ = leaveWhenSaved_ = false;
        naming_->hide();
        code_->setFocus();
    });
    for (auto* button : {save, back}) button->setAutoDefault(false);
    holder->hide();
    return holder;
}

QWidget* ScriptEditor::buildLeaving() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(new QLabel(tr("⚠ There are changes that are not saved."), holder), 1);
    const auto add = [&](const QString& text, const QString& tip, auto act) {
        auto* button = new QPushButton(text, holder);
        button->setAutoDefault(false);
        button->setToolTip(tip);
        connect(button, &QPushButton::clicked, this, act);
        row->addWidget(button);
    };
    add(tr("&Keep editing"), tr("Back to the text."), [this] {
        leaving_->hide();
        code_->setFocus();
    });
    add(tr("Save and close"), tr("Into the lab's own protocols."), [this] {
        leaving_->hide();
        leaveWhenSaved_ = true;
        save();
    });
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
        auto* made = new QPushButton(text, this);
        made->setToolTip(tip);
        made->setAutoDefault(false);
        connect(made, &QPushButton::clicked, this, slot);
        row->addWidget(made);
        return made;
    };
    const auto saveAndRun = [this] {
        runWhenSaved_ = !source_.shipped;
        if (runWhenSaved_ && !source_.path.empty() && !code_->document()->isModified()) {
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
    button(tr("C&lose"), tr("Closes the editor; asks where something is not saved."), &QDialog::reject);
    static_cast<QVBoxLayout*>(layout())->addLayout(row);
    connect(new QShortcut(QKeySequence::Save, this), &QShortcut::activated, this, &ScriptEditor::save);
    connect(new QShortcut(QKeySequence(Qt::Key_F5), this), &QShortcut::activated, this, saveAndRun);
}

}  // namespace tacto::gui
