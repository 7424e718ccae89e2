// Objects of mandoline-wasm/physics that keep a state here: see src/objects.js.
#include <emscripten/bind.h>

#include "complexes.h"
#include "mandoline/heat.h"
#include "mandoline/unsteady.h"

namespace {

using namespace mandoline;
using namespace mandoline::wasm;

/// What works on cells, which have to outlive it, until JavaScript deletes its handle.
template <class State>
class KeptState {
 public:
  template <class... Given>
  explicit KeptState(std::shared_ptr<const CellComplex> cells, Given&&... given)
      : both_(std::make_shared<Both>(std::move(cells), std::forward<Given>(given)...)) {}
  State* operator->() const { return &both_->state; }

 private:
  struct Both {
    template <class... Given>
    explicit Both(std::shared_ptr<const CellComplex> kept, Given&&... given)
        : cells(std::move(kept)), state(*cells, std::forward<Given>(given)...) {}

    std::shared_ptr<const CellComplex> cells;
    State state;
  };

  std::shared_ptr<Both> both_;
};

std::vector<double> numbersOf(const val& array) {
  std::vector<double> result;
  if (!array.isUndefined()) readArray(array, result);
  return result;
}

class KeptFlowStepper {
 public:
  explicit KeptFlowStepper(KeptState<FlowStepper> stepper) : stepper_(std::move(stepper)) {}

  val start(const val& cellVelocity) {
    return guarded([&] {
      stepper_->start(numbersOf(cellVelocity));
      return success(val::undefined());
    });
  }

  val step() {
    return guarded([&] { return success(toObject(stepper_->step())); });
  }

  val flow() const {
    return guarded([&] { return success(toObject(stepper_->flow())); });
  }

  val forces(const val& options) const {
    return guarded([&] {
      std::vector<uint32_t> faceGroup;
      if (!options["faceGroup"].isUndefined()) readArray(options["faceGroup"], faceGroup);
      val result = val::array();
      for (const SurfaceForce& force : stepper_->forces(faceGroup, readTriple<double>(options["centre"])))
        result.call<void>("push", toObject(force));
      return success(result);
    });
  }

 private:
  KeptState<FlowStepper> stepper_;
};

class KeptPoissonSolver {
 public:
  explicit KeptPoissonSolver(KeptState<PoissonSolver> solver) : solver_(std::move(solver)) {}

  val solve(const val& data, const val& options) {
    return guarded([&] {
      const std::vector<double> source = numbersOf(data["source"]), values = numbersOf(data["boundaryValue"]),
                                start = numbersOf(data["start"]);
      return success(toObject(solver_->solve({source, values, start}, readSolveOptions(options))));
    });
  }

 private:
  KeptState<PoissonSolver> solver_;
};

val poissonSolverOf(const KeptComplex& kept, const val& problem) {
  return guarded([&] {
    const auto cells = kept.get();
    return success(val(KeptPoissonSolver(KeptState<PoissonSolver>(cells, readProblem(problem, *cells)))));
  });
}

class KeptHeatStepper {
 public:
  explicit KeptHeatStepper(KeptState<HeatStepper> stepper) : stepper_(std::move(stepper)) {}

  val step(const val& options) {
    return guarded([&] { return success(val(std::string(name(stepper_->step(readSolveOptions(options)))))); });
  }
  val setSource(const val& source) {
    return guarded([&] {
      stepper_->setSource(numbersOf(source));
      return success(val::undefined());
    });
  }
  val setBoundaryValue(const val& values) {
    return guarded([&] {
      stepper_->setBoundaryValue(numbersOf(values));
      return success(val::undefined());
    });
  }
  val phi() const {
    return guarded([&] { return success(toArray(stepper_->phi())); });
  }
  val time() const { return success(val(stepper_->time())); }

 private:
  KeptState<HeatStepper> stepper_;
};

val heatStepperOf(const KeptComplex& kept, const val& heat) {
  return guarded([&] {
    const auto cells = kept.get();
    HeatProblem problem{readProblem(heat["problem"], *cells), numbersOf(heat["phi"]), heat["timeStep"].as<double>()};
    return success(val(KeptHeatStepper(KeptState<HeatStepper>(cells, std::move(problem)))));
  });
}

val flowStepperOf(const KeptComplex& kept, const val& wind, const val& options) {
  return guarded([&] {
    FlowStepperOptions stepperOptions;
    stepperOptions.viscosity = options["viscosity"].as<double>();
    stepperOptions.timeStep = options["timeStep"].as<double>();
    stepperOptions.courant = options["courant"].as<double>();
    stepperOptions.tolerance = options["tolerance"].as<double>();
    stepperOptions.maxIterations = options["maxIterations"].as<int>();
    stepperOptions.corrections = options["corrections"].as<int>();
    return success(val(KeptFlowStepper(KeptState<FlowStepper>(kept.get(), readTriple<double>(wind), stepperOptions))));
  });
}

val groupsOfFaces(const KeptCutMesh& keptCutMesh, const KeptComplex& keptCells, const val& groups) {
  return guarded([&, cutMesh = keptCutMesh.get(), cells = keptCells.get()] {
    return success(toArray(faceGroups(*cutMesh, *cells, fromObject<TriangleGroups>(groups).triangleGroup)));
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(steppers) {
  emscripten::class_<KeptFlowStepper>("KeptFlowStepper")
      .function("start", &KeptFlowStepper::start)
      .function("step", &KeptFlowStepper::step)
      .function("flow", &KeptFlowStepper::flow)
      .function("forces", &KeptFlowStepper::forces);
  emscripten::class_<KeptPoissonSolver>("KeptPoissonSolver").function("solve", &KeptPoissonSolver::solve);
  emscripten::class_<KeptHeatStepper>("KeptHeatStepper")
      .function("step", &KeptHeatStepper::step)
      .function("setSource", &KeptHeatStepper::setSource)
      .function("setBoundaryValue", &KeptHeatStepper::setBoundaryValue)
      .function("phi", &KeptHeatStepper::phi)
      .function("time", &KeptHeatStepper::time);
  emscripten::function("createPoissonSolver", &poissonSolverOf);
  emscripten::function("createHeatStepper", &heatStepperOf);
  emscripten::function("createFlowStepper", &flowStepperOf);
  emscripten::function("faceGroups", &groupsOfFaces);
}
