import { useEffect, useState } from 'preact/hooks';
import type { App } from '../app';
import { integer } from '../../model/format';
import { fileExtensions } from '../../model/formats';
import { openFile } from './open_file';

/** Opens files that are dropped anywhere on the page, and says so while one is held over it. */
export function Drops({ app }: { app: App }) {
  const [isOver, setOver] = useState(false);
  useEffect(() => {
    const over = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      setOver(true);
    };
    const leave = (event: DragEvent) => event.relatedTarget || setOver(false);
    const drop = (event: DragEvent) => {
      setOver(false);
      if (!hasFiles(event)) return;
      event.preventDefault();
      openOne(app, Array.from(event.dataTransfer?.files ?? []));
    };
    const listening = new AbortController();
    addEventListener('dragover', over, listening);
    addEventListener('dragleave', leave, listening);
    addEventListener('drop', drop, listening);
    return () => listening.abort();
  }, [app]);
  return (
    <div class="drop-veil" hidden={!isOver}>
      Drop a mesh to cut it
    </div>
  );
}

function hasFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes('Files') ?? false;
}

function openOne(app: App, files: readonly File[]): void {
  const file = firstMesh(files);
  if (!file) return;
  const others = files.filter((other) => other !== file);
  if (others.length > 0) app.state.notice(`The page shows one mesh at a time: ${file.name}. Not opened: ${namesOf(others)}.`);
  void openFile(app, file);
}

/** Of several files the one to open: the first that is a mesh by its name. */
function firstMesh(files: readonly File[]): File | undefined {
  const isMesh = ({ name }: File) => fileExtensions.some((extension) => name.toLowerCase().endsWith(extension));
  return files.find(isMesh) ?? files[0];
}

const mostNames = 5;

function namesOf(files: readonly File[]): string {
  const more = files.length > mostNames ? ` and ${integer(files.length - mostNames)} more` : '';
  const names = files.slice(0, mostNames).map(({ name }) => name);
  return names.join(', ') + more;
}
