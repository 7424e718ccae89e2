#include "cli/arguments.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "cli/suggest.h"
#include "cli/values.h"

namespace mandoline::cli {
namespace {

class Parser {
 public:
  explicit Parser(const std::vector<std::string>& words) : words_(words) {}

  Arguments parse() {
    if (words_.empty()) throw UsageError("a command is missing");
    for (const std::string& word : words_) {
      if (word == "--help" || word == "-h") return arguments_;
    }
    parseCommand(words_[next_++]);
    if (arguments_.command == Command::help || arguments_.command == Command::version) return arguments_;
    while (next_ < words_.size()) parseWord(words_[next_++]);
    check();
    return arguments_;
  }

 private:
  /// Takes its value, if any, from the parser.
  struct Option {
    const char* name;
    std::vector<Command> commands;
    void (*parse)(Parser&, const std::string& name);
  };

  static constexpr std::pair<const char*, Command> kCommands[] = {
      {"cut", Command::cut},         {"slice", Command::slice}, {"boundary", Command::boundary},
      {"flow", Command::flow},       {"info", Command::info},   {"make", Command::make},
      {"resolve", Command::resolve}, {"help", Command::help},   {"--version", Command::version}};

  static const std::vector<Option>& options() {
    using C = Command;
    static const std::vector<C> kCutting = {C::cut, C::slice, C::boundary, C::flow};
    static const std::vector<C> kCuttingAndResolve = {C::cut, C::slice, C::boundary, C::flow, C::resolve};
    static const std::vector<C> kAllButMake = {C::cut, C::slice, C::boundary, C::flow, C::info, C::resolve};
    static const std::vector<C> kAll = {C::cut, C::slice, C::boundary, C::flow, C::info, C::make, C::resolve};
    static const std::vector<Option> kOptions = {
        {"--report", kAllButMake, [](Parser& p, const std::string& name) { p.arguments_.report = p.value(name); }},
        {"--cells", kCutting, [](Parser& p, const std::string& name) { parseCells(p.value(name), p.arguments_.grid); }},
        {"--margin", kCutting, [](Parser& p, const std::string& name) { parseMargin(p.value(name), p.arguments_.grid); }},
        {"--box", kCutting, [](Parser& p, const std::string& name) { parseBox(p.value(name), p.arguments_.grid); }},
        {"--origin", kCutting, [](Parser& p, const std::string& name) { parseOrigin(p.value(name), p.arguments_.grid); }},
        {"--spacing", kCutting, [](Parser& p, const std::string& name) { parseSpacing(p.value(name), p.arguments_.grid); }},
        {"--planes", kCutting, [](Parser& p, const std::string& name) { parsePlanes(p.value(name), p.arguments_.grid); }},
        {"--snap-tolerance", kCutting, [](Parser& p, const std::string& name) { p.parseSnapTolerance(p.value(name)); }},
        {"--intersections", kCutting, [](Parser& p, const std::string& name) { p.parseIntersections(p.value(name)); }},
        {"--threads", kAllButMake, [](Parser& p, const std::string& name) { p.parseThreads(p.value(name)); }},
        {"--orient", kCuttingAndResolve, [](Parser& p, const std::string&) { p.arguments_.orient = true; }},
        {"--validate", {C::cut}, [](Parser& p, const std::string&) { p.arguments_.validate = true; }},
        {"--stream", {C::cut}, [](Parser& p, const std::string&) { p.arguments_.stream = true; }},
        {"--coarsen", {C::cut, C::flow}, [](Parser& p, const std::string& name) { p.parseCoarsen(p.value(name)); }},
        {"--refine", {C::cut, C::flow}, [](Parser& p, const std::string& name) { p.parseRefine(p.value(name)); }},
        {"--refine-box", {C::cut, C::flow}, [](Parser& p, const std::string& name) { p.parseRefineBox(p.value(name)); }},
        {"--merge", {C::cut, C::flow}, [](Parser& p, const std::string& name) { p.parseMerge(p.value(name)); }},
        {"--unite-walls", {C::cut, C::flow}, [](Parser& p, const std::string& name) { p.parseUniteWalls(p.value(name)); }},
        {"--faces", {C::cut, C::flow}, [](Parser& p, const std::string&) { p.arguments_.faces = true; }},
        {"--simple-cells", {C::cut, C::flow}, [](Parser& p, const std::string&) { p.arguments_.simpleCells = true; }},
        {"--wind", {C::flow}, [](Parser& p, const std::string& name) { parseWind(p.value(name), p.arguments_.flow); }},
        {"--far-field", {C::flow}, [](Parser& p, const std::string&) { p.arguments_.flow.farField = true; }},
        {"--corrections", {C::flow}, [](Parser& p, const std::string& name) { parseCorrections(p.value(name), p.arguments_.flow); }},
        {"--streamlines", {C::flow}, [](Parser& p, const std::string& name) { parseStreamlines(p.value(name), p.arguments_.flow); }},
        {"--steps", {C::flow}, [](Parser& p, const std::string& name) { parseSteps(p.value(name), p.arguments_.flow); }},
        {"--viscosity", {C::flow}, [](Parser& p, const std::string& name) { parseViscosity(p.value(name), p.arguments_.flow); }},
        {"--axis", {C::slice}, [](Parser& p, const std::string& name) { parseAxis(p.value(name), p.arguments_.slice); }},
        {"--normal", {C::slice}, [](Parser& p, const std::string& name) { parseNormal(p.value(name), p.arguments_.slice); }},
        {"--heights", {C::slice}, [](Parser& p, const std::string& name) { parseHeights(p.value(name), p.arguments_.slice); }},
        {"--layers", {C::slice}, [](Parser& p, const std::string& name) { parseLayers(p.value(name), p.arguments_.slice); }},
        {"--only", kCutting, [](Parser& p, const std::string& name) { parseOnly(p.value(name), p.arguments_.only); }},
        {"--inside-threshold", kCutting, [](Parser& p, const std::string& name) { p.parseInsideThreshold(p.value(name)); }},
        {"--rule", {C::resolve}, [](Parser& p, const std::string& name) { p.parseRule(p.value(name)); }},
        {"--format", kAll, [](Parser& p, const std::string& name) { p.parseFormat(p.value(name)); }},
        {"-o", kAll, [](Parser& p, const std::string& name) { p.parseOutputs(name); }},
    };
    return kOptions;
  }

  void parseCommand(const std::string& word) {
    const auto found = std::find_if(std::begin(kCommands), std::end(kCommands), [&](const auto& command) { return word == command.first; });
    if (found == std::end(kCommands)) {
      std::vector<std::string> names;
      for (const auto& command : kCommands) names.push_back(command.first);
      throw UsageError("unknown command '" + word + "'" + question(nearest(word, names)));
    }
    arguments_.command = found->second;
  }

  /// An option's value is the next word, or comes after a '=' as in --cells=32.
  void parseWord(const std::string& whole) {
    const size_t equals = whole.starts_with("--") ? whole.find('=') : std::string::npos;
    const std::string word = whole.substr(0, equals);
    if (equals != std::string::npos) attached_ = whole.substr(equals + 1);
    const auto option = std::find_if(options().begin(), options().end(), [&](const Option& o) { return word == o.name && belongs(o); });
    if (option != options().end()) {
      const bool isRepeatable = word == "-o" || word == "--refine-box";
      if (!given_.insert(word).second && !isRepeatable) throw UsageError(word + " is given twice");
      option->parse(*this, word);
    } else if (word.empty() || (word[0] == '-' && word != "-")) {
      refuseOption(word);
    } else {
      parseOperand(word);
    }
    if (attached_) throw UsageError(word + " takes no value");
  }

  bool belongs(const Option& option) const {
    return std::find(option.commands.begin(), option.commands.end(), arguments_.command) != option.commands.end();
  }

  /// Names the option that may have been meant, among those of the command, else among all.
  [[noreturn]] void refuseOption(const std::string& word) const {
    std::vector<std::string> own, others;
    for (const Option& option : options()) (belongs(option) ? own : others).push_back(option.name);
    const auto other = std::find_if(options().begin(), options().end(), [&](const Option& option) { return word == option.name; });
    if (other != options().end()) throw UsageError(word + " is an option of " + commandsOf(*other));
    std::string meant = nearest(word, own);
    if (meant.empty()) meant = nearest(word, others);
    throw UsageError("unknown option '" + word + "'" + question(meant));
  }

  static std::string commandsOf(const Option& option) {
    std::string text;
    for (size_t i = 0; i < option.commands.size(); ++i) {
      const auto named = [&](const auto& command) { return command.second == option.commands[i]; };
      if (i > 0) text += i + 1 == option.commands.size() ? " and " : ", ";
      text += std::find_if(std::begin(kCommands), std::end(kCommands), named)->first;
    }
    return text;
  }

  static std::string question(const std::string& meant) { return meant.empty() ? "" : ": did you mean " + meant + "?"; }

  void parseOperand(const std::string& word) {
    const bool makes = arguments_.command == Command::make;
    std::string& operand = makes ? arguments_.shape : arguments_.mesh;
    if (!operand.empty())
      throw UsageError(std::string("one ") + (makes ? "shape" : "mesh") + " at a time: '" + operand + "' or '" + word + "'?");
    operand = word;
  }

  std::string value(const std::string& option) {
    std::string value;
    if (attached_) {
      value.swap(*attached_);
      attached_.reset();
    } else if (next_ < words_.size()) {
      value = words_[next_++];
    }
    if (value.empty()) throw UsageError(option + " needs a value");
    return value;
  }

  void parseOutputs(const std::string& option) {
    const auto isOutput = [](const std::string& word) { return word == "-" || !word.starts_with('-'); };
    arguments_.outputs.push_back(value(option));
    while (next_ < words_.size() && isOutput(words_[next_])) arguments_.outputs.push_back(words_[next_++]);
  }

  void parseFormat(const std::string& word) {
    arguments_.format = formatOf('.' + word);
    if (!arguments_.format) throw UsageError("--format needs an extension such as vtu, not '" + word + "'");
  }

  void parseInsideThreshold(const std::string& word) {
    double threshold = 0;
    if (!parseNumber(word, threshold) || !(threshold > 0 && threshold <= 1))
      throw UsageError("--inside-threshold needs a number above 0 and at most 1, not '" + word + "'");
    arguments_.insideThreshold = threshold;
  }

  void parseSnapTolerance(const std::string& word) {
    double& tolerance = arguments_.snapTolerance;
    if (!parseNumber(word, tolerance) || !(tolerance >= 0 && tolerance < 0.5)) {
      throw UsageError("--snap-tolerance needs a number from 0 to below 0.5, not '" + word + "'");
    }
  }

  void parseIntersections(const std::string& word) {
    constexpr std::pair<const char*, Intersections> kWords[] = {
        {"resolve", Intersections::resolve}, {"refuse", Intersections::refuse}, {"assume-none", Intersections::assumeNone}};
    const auto found = std::find_if(std::begin(kWords), std::end(kWords), [&](const auto& choice) { return word == choice.first; });
    if (found == std::end(kWords)) throw UsageError("--intersections needs resolve, refuse or assume-none, not '" + word + "'");
    arguments_.intersections = found->second;
  }

  void parseThreads(const std::string& word) {
    if (!parseNumber(word, arguments_.threads)) throw UsageError("--threads needs a number of threads, not '" + word + "'");
  }

  void parseCoarsen(const std::string& word) {
    const std::vector<int> numbers = parseList<int>(word);
    if (numbers.empty() || numbers.size() > 2 || std::min(numbers.front(), numbers.back()) < 0)
      throw UsageError("--coarsen needs a number of levels, or LEVELS,LAYERS, not '" + word + "'");
    arguments_.coarsen = numbers[0];
    if (numbers.size() > 1) arguments_.coarsenLayers = numbers[1];
  }

  static bool isLevel(double x) { return x >= 0 && x <= 24 && x == std::floor(x); }

  void parseRefine(const std::string& word) {
    const std::vector<double> numbers = parseList<double>(word);
    const bool fit = !numbers.empty() && numbers.size() <= 2 && isLevel(numbers[0]);
    if (!fit || !(numbers.back() >= 0 && numbers.back() <= 180))
      throw UsageError("--refine needs a number of levels from 0 to 24, or LEVELS,DEGREES up to 180, not '" + word + "'");
    arguments_.refine = int(numbers[0]);
    if (numbers.size() > 1) arguments_.refineAngle = numbers[1];
  }

  void parseRefineBox(const std::string& word) {
    const std::vector<double> n = parseList<double>(word);
    if (n.size() != 7 || !(n[0] < n[3] && n[1] < n[4] && n[2] < n[5]) || !isLevel(n[6]))
      throw UsageError("--refine-box needs X0,Y0,Z0,X1,Y1,Z1,LEVELS with ascending corners and up to 24 levels, not '" + word + "'");
    arguments_.refineBoxes.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, int(n[6])});
  }

  void parseMerge(const std::string& word) {
    double fraction = 0;
    if (!parseNumber(word, fraction) || !(fraction >= 0 && fraction <= 0.5))
      throw UsageError("--merge needs a number from 0 to 0.5, not '" + word + "'");
    arguments_.merge = fraction;
  }

  void parseUniteWalls(const std::string& word) {
    double angle = 0;
    if (!parseNumber(word, angle) || !(angle >= 0 && angle <= 90))
      throw UsageError("--unite-walls needs an angle from 0 to 90 degrees, not '" + word + "'");
    arguments_.uniteWalls = angle;
  }

  void parseRule(const std::string& word) {
    constexpr std::pair<const char*, WindingRule> kRules[] = {
        {"positive", WindingRule::positive}, {"non-zero", WindingRule::nonZero}, {"odd", WindingRule::odd}};
    const auto found = std::find_if(std::begin(kRules), std::end(kRules), [&](const auto& rule) { return word == rule.first; });
    if (found == std::end(kRules)) throw UsageError("--rule is positive, non-zero or odd, not '" + word + "'");
    arguments_.rule = found->second;
  }

  static void checkRefine(const Arguments& a) {
    if (!a.refines()) return;
    if (a.snapTolerance > 0) throw UsageError("--refine and --refine-box do not go with --snap-tolerance");
    if (a.insideThreshold) throw UsageError("--refine and --refine-box do not go with --inside-threshold");
  }

  void check() const {
    const Arguments& a = arguments_;
    const bool makes = a.command == Command::make;
    if (makes && a.shape.empty()) throw UsageError("the shape is missing");
    if (!makes && a.mesh.empty()) throw UsageError("the mesh is missing");
    checkGrid(a.grid);
    if (given_.count("--axis") + given_.count("--normal") > 1) throw UsageError("only one of --axis and --normal");
    if (a.command == Command::slice) checkSlice(a.slice, a.only);
    if (a.faces && a.simpleCells) throw UsageError("--simple-cells does not go with --faces, which writes no cells");
    if (a.only.all && a.command != Command::cut) throw UsageError("--only all: only cut leaves regions out, of polyMeshes");
    if (a.command == Command::boundary && a.only.cut) throw UsageError("--only cut: a boundary is that of whole regions");
    if (a.command == Command::flow) checkFlow(a.flow);
    checkRefine(a);
    const bool toStandardOutput = std::find(a.outputs.begin(), a.outputs.end(), "-") != a.outputs.end();
    if (toStandardOutput && !a.format) throw UsageError("-o - needs --format, such as --format vtu");
    if (!toStandardOutput && a.format) throw UsageError("--format is for -o -; other files tell by their extension");
    if (a.command != Command::cut && a.command != Command::info && a.outputs.empty()) throw UsageError("-o is missing");
  }

  const std::vector<std::string>& words_;
  size_t next_ = 0;
  std::set<std::string> given_;          ///< options
  std::optional<std::string> attached_;  ///< value of the option being parsed
  Arguments arguments_;
};

}  // namespace

void refuseOptions(RefusedOptions options, const std::string& before, const std::string& after) {
  for (const auto& [isGiven, name] : options) {
    if (isGiven) throw UsageError(before + name + after);
  }
}

Arguments parseArguments(const std::vector<std::string>& words) { return Parser(words).parse(); }

}  // namespace mandoline::cli
