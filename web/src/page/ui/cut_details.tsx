import { useEffect, useState } from 'preact/hooks';
import type { App } from '../app';
import type { Model } from '../../model/cut_model';
import { integer, milliseconds, plural, real, words } from '../../model/format';
import { Terms } from './controls/terms';

/** For the curious: further counts, the time of each stage, what was left out. */
export function CutDetails({ app }: { app: App }) {
  const { model } = app;
  const [isOpen, setOpen] = useState(false);
  const [edges, setEdges] = useState<{ of: Model; count: number } | null>(null);
  useEffect(() => {
    if (isOpen && model) void app.countEdges().then((count) => count !== null && setEdges({ of: model, count }));
  }, [isOpen, model, app]);
  return (
    <details onToggle={({ currentTarget }) => setOpen(currentTarget.open)}>
      <summary>Stages and details</summary>
      <div id="cut-details">
        {model && (
          <>
            <MoreCounts model={model} edges={edges?.of === model ? edges.count : null} />
            <StageTimes model={model} />
            <LeftOut model={model} />
          </>
        )}
      </div>
    </details>
  );
}

/** The edges are counted when they are seen. */
function MoreCounts({ model: { counts, stats }, edges }: { model: Model; edges: number | null }) {
  return (
    <Terms
      class="counts"
      list={[
        ['faces', integer(counts.faces)],
        ['edges', edges === null ? '…' : integer(edges)],
        ['vertices', integer(counts.vertices)],
        ['signs decided by exact arithmetic', integer(stats.exactFallbacks)],
      ]}
    />
  );
}

function StageTimes({ model: { stats, estimateMs } }: { model: Model }) {
  const stages = [...stats.stages, ...(estimateMs === null ? [] : [{ stage: 'estimateOfInside', ms: estimateMs }])];
  const longest = Math.max(...stages.map(({ ms }) => ms), Number.MIN_VALUE);
  return (
    <table class="times" id="stage-times">
      <caption>Time per stage</caption>
      <tbody>
        {stages.map(({ stage, ms }) => (
          <tr key={stage}>
            <th scope="row">{words(stage)}</th>
            <td class="bar-cell">
              <span class="bar" style={{ width: `${(100 * ms) / longest}%` }} />
            </td>
            <td>{milliseconds(ms)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** Pairs of triangles that meet other than in shared vertices and edges, which the cut has resolved. */
function meetings({ intersections, intersectionCurves }: Model['stats']): string[] {
  const { crossing, touching, overlapping, folded, identical } = intersections;
  const kinds = { crossing, touching, overlapping, folded, identical };
  const facts = Object.entries(kinds).flatMap(([kind, count]) => (count > 0 ? [`${plural(count, 'pair')} of triangles ${kind}`] : []));
  return intersectionCurves > 0 ? [...facts, `${plural(intersectionCurves, 'curve')} along which triangles meet`] : facts;
}

/** Parts of the mesh that have no winding numbers, in the words of the command line. */
function withoutWinding({ parts }: Model['stats']): string[] {
  const { winding, parity, open, openEdges, holes } = parts;
  const all = plural(winding + parity + open, 'part');
  const edges = `${plural(openEdges, 'open edge')} around ${plural(holes, 'hole')}`;
  return [
    ...(parity > 0 ? [`${integer(parity)} of ${all} not consistently oriented: inside by parity`] : []),
    ...(open > 0 ? [`${integer(open)} of ${all} open, with ${edges}: inside by an estimate`] : []),
  ];
}

function LeftOut({ model: { stats } }: { model: Model }) {
  const facts = [
    stats.zeroAreaTriangles && `${plural(stats.zeroAreaTriangles, 'degenerate triangle')} dropped`,
    stats.outsideTriangles && `${plural(stats.outsideTriangles, 'triangle')} outside the grid dropped`,
    ...meetings(stats),
    ...withoutWinding(stats),
    stats.weldedVertices && `${plural(stats.weldedVertices, 'vertex', 'vertices')} welded to another at the same position`,
    stats.snappedVertices && `${plural(stats.snappedVertices, 'vertex', 'vertices')} snapped, by up to ${real(stats.largestSnap)} cells`,
    stats.flushedCoordinates && `${plural(stats.flushedCoordinates, 'tiny coordinate')} set to 0`,
  ].filter((fact) => typeof fact === 'string');
  if (facts.length === 0) return <p id="left-out">Nothing dropped, welded or moved.</p>;
  return (
    <ul id="left-out">
      {facts.map((fact) => (
        <li key={fact}>{fact}</li>
      ))}
    </ul>
  );
}
