// Laminar flow at a Reynolds number of 100 about the walls of a polyMesh, by OpenFOAM's icoFoam and simpleFoam, of second order in space.
import { makeCase, tryFoam, writeControls, writeField, writeInput } from './openfoam.mjs';

const schemes = (ddt, bounded) => `ddtSchemes { default ${ddt}; } gradSchemes { default Gauss linear; }
divSchemes { default none; div(phi,U) ${bounded} Gauss linearUpwind grad(U); div((nuEff*dev2(T(grad(U))))) Gauss linear; }
interpolationSchemes { default linear; } laplacianSchemes { default Gauss linear corrected; } snGradSchemes { default corrected; }`;
const unsteady = schemes('Euler', '');
const steady = schemes('steadyState', 'bounded');
const solution = `solvers {
  p { solver GAMG; smoother GaussSeidel; tolerance 1e-7; relTol 0.01; } pFinal { $p; relTol 0; }
  U { solver PBiCGStab; preconditioner DILU; tolerance 1e-8; relTol 0.01; } UFinal { $U; relTol 0; } }
PISO { nCorrectors 2; nNonOrthogonalCorrectors 1; }
SIMPLE { consistent yes; nNonOrthogonalCorrectors 1; residualControl { p 1e-4; U 1e-4; } }
relaxationFactors { equations { ".*" 0.7; } }`;

/** A case without a mesh. */
export const makeLaminarCase = () => makeCase({ schemes: unsteady, solution, precision: 12 });

/** A wind of speed 1 enters at xMin and leaves at xMax; the other sides slip. `size` of what it flows about. */
function writeWind(folder, size) {
  const sides = (condition) => Object.fromEntries(['yMin', 'yMax', 'zMin', 'zMax'].map((side) => [side, condition]));
  writeField(folder, 'U', {
    type: 'volVectorField',
    dimensions: '[0 1 -1 0 0 0 0]',
    inside: '(1 0 0)',
    patches: {
      '".*"': 'noSlip',
      xMin: 'fixedValue; value uniform (1 0 0)',
      xMax: 'inletOutlet; inletValue uniform (0 0 0); value uniform (1 0 0)',
      ...sides('slip'),
    },
  });
  writeField(folder, 'p', {
    type: 'volScalarField',
    dimensions: '[0 2 -2 0 0 0 0]',
    inside: '0',
    patches: { '".*"': 'zeroGradient', xMax: 'fixedValue; value uniform 0', ...sides('slip') },
  });
  writeInput(folder, 'constant', 'transportProperties', 'dictionary', `transportModel Newtonian; nu ${size / 100};`);
  writeInput(folder, 'constant', 'turbulenceProperties', 'dictionary', 'simulationType laminar;');
}

const numbersIn = (text, pattern) => [...text.matchAll(pattern)].map((match) => Number(match[1]));

/** 60 steps, each of which takes the wind a fifth of `h`: the largest Courant number, or NaN if the solver stops or is not finite. */
export function runIcoFoam(folder, { size, h }) {
  writeWind(folder, size);
  writeInput(folder, 'system', 'fvSchemes', 'dictionary', unsteady);
  writeControls(folder, { steps: 60, step: h / 5 });
  const { output, status } = tryFoam(folder, 'icoFoam');
  const residuals = numbersIn(output, /(?:Initial|Final) residual = ([^,]+),/g);
  const courant = numbersIn(output, /^Courant Number mean: \S+ max: (\S+)/gm);
  return status === 0 && residuals.every(Number.isFinite) && courant.length === 60 ? Math.max(...courant) : NaN;
}

/** Until all residuals are at most 1e-4: iterations, NaN if 300 are not enough, and the drag coefficient for an area of `size` squared. */
export function runSimpleFoam(folder, { size }) {
  writeWind(folder, size);
  writeInput(folder, 'system', 'fvSchemes', 'dictionary', steady);
  const drag = `drag { type forceCoeffs; libs ("libforces.so"); log true; patches (surface); rho rhoInf; rhoInf 1; CofR (0 0 0);
    dragDir (1 0 0); liftDir (0 0 1); pitchAxis (0 1 0); magUInf 1; lRef ${size}; Aref ${size ** 2}; }`;
  writeControls(folder, { steps: 300, functions: drag });
  const { output } = tryFoam(folder, 'simpleFoam');
  const [iterations] = numbersIn(output, /SIMPLE solution converged in (\d+) iterations/g);
  return { iterations: iterations ?? NaN, drag: numbersIn(output, /^\s*Cd\s*:\s*(\S+)/gm).at(-1) };
}
