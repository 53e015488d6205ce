#include "app/scripting/child/Sandbox.h"

#include <QRegularExpression>
#include <QSet>
#include <QUrl>
#include <algorithm>
#include <fmt/format.h>
#include <new>
#include <utility>

#include "app/scripting/child/HostBridge.h"
#include "app/scripting/child/JsValue.h"
#include "core/base/JsonText.h"

namespace tacto {

namespace {

/// Machine code that the engine compiles cannot be unwound: std::bad_alloc inside it would abort the program. With
/// interpreted code, evaluate() catches std::bad_alloc. Set before any engine exists.
[[maybe_unused]] const bool kInterpreted = qputenv("QV4_FORCE_INTERPRETER", "1");

const QString kHostFile = QStringLiteral("tactoscope:host");
const QString kStartFile = QStringLiteral("tactoscope:start");

/// Runs before the script, so the script cannot have changed anything that is looked up here. Later the functions look
/// up nothing that a script can change.
const QString kInstall = QStringLiteral(R"js(
(function (host, global, table, makers) {
    "use strict";
    const define = Object.defineProperty, freeze = Object.freeze;
    const objects = {};
    for (let i = 0; i < table.length; ++i) {
        const entry = table[i];
        const native = (...given) => host.call(i, given);
        const made = makers[i] ? makers[i](native) : native;
        define(made, "name", { value: entry.name });
        freeze(made);
        const what = entry.property ? { get: () => host.call(i, []), enumerable: true }
                                    : { value: made, enumerable: true };
        if (entry.object === "") { define(global, entry.name, what); continue; }
        if (!objects[entry.object]) {
            objects[entry.object] = Object.create(null);
            const dot = entry.object.indexOf(".");  // "bench.loadSafety": an object within one that is there
            if (dot > 0) {
                define(objects[entry.object.slice(0, dot)], entry.object.slice(dot + 1),
                       { value: objects[entry.object], enumerable: true });
            }
        }
        define(objects[entry.object], entry.name, what);
        if (entry.object === "random" && entry.name === "uniform") {
            define(Math, "random", { value: freeze(() => host.call(i, [0, 1])), writable: false, configurable: false });
        }
    }
    for (const name in objects) {
        freeze(objects[name]);
        if (name.indexOf(".") < 0) define(global, name, { value: objects[name], enumerable: true });
    }
})
)js");

/// The engine turns a path into a file URL; its stack traces name that URL.
QString urlOf(const std::string& file) {
    const QString name = QString::fromStdString(file);
    return name.startsWith(QLatin1Char('/')) ? QUrl::fromLocalFile(name).toString() : name;
}

}  // namespace

struct Sandbox::Engine {
    Engine(HostCalls& calls, const std::vector<SeenFunction>& functions, std::string from, std::string given)
        : text(std::move(given)), file(std::move(from)), bridge(std::make_unique<HostBridge>(js, calls, urlOf(file))) {
        removeForeignGlobals();
        installHost(functions);
        for (const auto& function : functions) {
            const auto name = QString::fromStdString(function.object.empty() ? function.name : function.object);
            if (!name.contains(QLatin1Char('.')) && !hostNames.contains(name)) hostNames.push_back(name);
        }
    }

    void removeForeignGlobals();
    void installHost(const std::vector<SeenFunction>& functions);
    [[nodiscard]] std::optional<Thrown> evaluate(const QString& code, const QString& from, QJSValue* result = nullptr);
    [[nodiscard]] Thrown errorFrom(const QJSValue& thrown, const QStringList& trace) const;

    QJSEngine js;
    const std::string text;
    const std::string file;
    QStringList hostNames;  // the host's global names
    std::unique_ptr<HostBridge> bridge;
    bool ranOutOfMemory = false;
};

Sandbox::Sandbox(HostCalls& calls, const std::vector<SeenFunction>& functions, std::string file, std::string text)
    : engine_(std::make_unique<Engine>(calls, functions, std::move(file), std::move(text))) {}

Sandbox::~Sandbox() {
    // The engine is in an undefined state, so it is not destroyed.
    if (engine_->ranOutOfMemory) static_cast<void>(engine_.release());
}

void Sandbox::Engine::removeForeignGlobals() {
    static const QSet<QString> kKept = {"Object",
                                        "String",
                                        "Symbol",
                                        "Number",
                                        "Boolean",
                                        "Array",
                                        "Function",
                                        "Date",
                                        "RegExp",
                                        "Error",
                                        "EvalError",
                                        "RangeError",
                                        "ReferenceError",
                                        "SyntaxError",
                                        "TypeError",
                                        "URIError",
                                        "ArrayBuffer",
                                        "DataView",
                                        "WeakSet",
                                        "Set",
                                        "WeakMap",
                                        "Map",
                                        "Int8Array",
                                        "Uint8Array",
                                        "Int16Array",
                                        "Uint16Array",
                                        "Int32Array",
                                        "Uint32Array",
                                        "Uint8ClampedArray",
                                        "Float32Array",
                                        "Float64Array",
                                        "Math",
                                        "JSON",
                                        "Reflect",
                                        "Proxy",
                                        "undefined",
                                        "NaN",
                                        "Infinity",
                                        "eval",
                                        "parseInt",
                                        "parseFloat",
                                        "isNaN",
                                        "isFinite",
                                        "decodeURI",
                                        "decodeURIComponent",
                                        "encodeURI",
                                        "encodeURIComponent",
                                        "escape",
                                        "unescape"};
    QJSValue global = js.globalObject();
    const QJSValue names = js.evaluate(QStringLiteral("Object.getOwnPropertyNames")).call({global});
    const quint32 count = names.property(QStringLiteral("length")).toUInt();
    for (quint32 i = 0; i < count; ++i) {
        const QString name = names.property(i).toString();
        if (!kKept.contains(name)) global.deleteProperty(name);
    }
}

void Sandbox::Engine::installHost(const std::vector<SeenFunction>& functions) {
    QJSValue table = js.newArray(static_cast<uint>(functions.size()));
    QJSValue makers = js.newArray(static_cast<uint>(functions.size()));
    for (std::size_t i = 0; i < functions.size(); ++i) {
        QJSValue entry = js.newObject();
        entry.setProperty(QStringLiteral("object"), QString::fromStdString(functions[i].object));
        entry.setProperty(QStringLiteral("name"), QString::fromStdString(functions[i].name));
        entry.setProperty(QStringLiteral("property"), functions[i].property);
        table.setProperty(static_cast<quint32>(i), entry);
        if (functions[i].javascript.empty()) continue;
        const QString code = QString::fromStdString(functions[i].javascript);
        const QJSValue maker = js.evaluate(
            QStringLiteral("(function (native) { \"use strict\"; return (") + code + QStringLiteral("); })"),
            kHostFile);
        Q_ASSERT_X(!maker.isError(), "Sandbox", qPrintable(maker.toString()));
        makers.setProperty(static_cast<quint32>(i), maker);
    }
    QJSEngine::setObjectOwnership(bridge.get(), QJSEngine::CppOwnership);
    const QJSValue install = js.evaluate(kInstall, kHostFile);
    const QJSValue done = install.call({js.newQObject(bridge.get()), js.globalObject(), table, makers});
    // Without its host objects a script would run against nothing, or against objects of its own.
    if (done.isError()) qFatal("host objects could not be installed: %s", qPrintable(done.toString()));
}

std::optional<Thrown> Sandbox::load() {
    // Only the script's own text sees its `let` and `const`, so the check for its functions is appended to that text.
    const QStringList& names = engine_->hostNames;
    const QString text = QStringLiteral("\"use strict\"; ") + QString::fromStdString(engine_->text) +
                         QStringLiteral("\n;({ run: typeof run === 'function' ? run : null, held: [") +
                         names.join(QLatin1Char(',')) + QStringLiteral("] })");
    QJSValue end;
    if (auto error = engine_->evaluate(text, QString::fromStdString(engine_->file), &end)) return error;

    const QJSValue held = end.property(QStringLiteral("held"));
    for (qsizetype i = 0; held.isArray() && i < names.size(); ++i) {
        if (held.property(static_cast<quint32>(i)).strictlyEquals(engine_->js.globalObject().property(names[i])))
            continue;
        return Thrown{.reason = fmt::format("the script defines {0}, but {0} belongs to the program; choose another "
                                            "name",
                                            names[i].toStdString()),
                      .line = 1};
    }
    const QJSValue entry = end.property(QStringLiteral("run"));
    if (!entry.isCallable()) {
        return Thrown{.reason = "the script has no function run(p)", .line = 1};
    }
    engine_->js.globalObject().setProperty(QStringLiteral("run"), entry);
    return std::nullopt;
}

std::optional<Thrown> Sandbox::run(const nlohmann::json& parameters) {
    const std::string given = dumpJson(parameters, -1, true);  // ASCII, so it is always a valid JavaScript literal
    return engine_->evaluate(QStringLiteral("run(") + QString::fromStdString(given) + QLatin1Char(')'), kStartFile);
}

std::optional<Thrown> Sandbox::Engine::evaluate(const QString& code, const QString& from, QJSValue* result) {
    QStringList trace;
    QJSValue value;
    try {
        value = js.evaluate(code, from, 1, &trace);
    } catch (const std::bad_alloc&) {
        ranOutOfMemory = true;
        return Thrown{.reason = "the script asked for more memory than there is; output is off", .outOfMemory = true};
    }
    if (result != nullptr) *result = value;
    if (trace.isEmpty() && !value.isError()) return std::nullopt;
    if (trace.isEmpty() && from == kStartFile) return std::nullopt;  // run() returned an Error without throwing it
    return errorFrom(value, trace);
}

Thrown Sandbox::Engine::errorFrom(const QJSValue& thrown, const QStringList& trace) const {
    Thrown error;
    // "function:line:column:file", innermost first. The author can act on the innermost line of the script itself.
    static const QRegularExpression frame(QStringLiteral(R"(^(.*?):(-?\d+):(-?\d+):(.*)$)"));
    const QString url = urlOf(file);
    // After a stack overflow, Qt 6.8 may report any line. Errors of a script that was cut short lie behind its text.
    const auto lineIn = [lines = std::ranges::count(text, '\n') + 3](const QString& number) {
        const int line = number.toInt();
        return line >= 1 && line <= lines ? line : 0;
    };
    for (const QString& entry : trace) {
        const auto match = frame.match(entry);
        if (!match.hasMatch() || match.captured(4) != url) continue;
        error.line = lineIn(match.captured(2));
        if (error.line != 0) break;
    }
    if (error.line == 0) error.line = lineIn(thrown.property(QStringLiteral("lineNumber")).toString());

    error.failure = bridge->failureOf(thrown);
    if (error.failure) return error;  // the program knows this failure's code and sentence
    if (!thrown.isError()) {
        error.reason = thrown.toString().toStdString();
        if (thrown.isObject() && !thrown.isCallable()) {
            if (auto plain = toJson(thrown)) error.reason = dumpJson(*plain);
        }
        return error;
    }
    const QString name = thrown.property(QStringLiteral("name")).toString();
    const QString message = thrown.property(QStringLiteral("message")).toString();
    if (name == QStringLiteral("TypeError") && message == QStringLiteral("Type error")) {  // the engine's whole message
        error.reason = "TypeError: something that belongs to the program, or is constant, was written or deleted";
        return error;
    }
    error.reason = (name == QStringLiteral("Error") ? message : name + QStringLiteral(": ") + message).toStdString();
    if (error.reason.empty()) error.reason = "an Error without a message";
    return error;
}

}  // namespace tacto
