// Several threads as one for the queue of jobs: the first leads, and the others take shares of its cuts (see shares.js).
import { startThread } from './thread.js';

/**
 * Starts a thread as startThread() does, which leads, and `count - 1` others when it asks for them; each of these starts the compiled module
 * by itself. It has the ports to all of them from the beginning: what it asks waits there until they have started.
 */
export function startCrew(source, { onMessage, onDeath }, { count, module }) {
  const others = [];
  const lead = startThread(source, { onMessage: (message) => (message.type === 'share' ? startOthers() : onMessage(message)), onDeath });
  const ports = Array.from({ length: count - 1 }, (_, number) => {
    const { port1, port2 } = new MessageChannel();
    lead.post({ mate: number, port: port1 }, [port1]);
    return port2;
  });
  const startOthers = () => {
    for (const [number, port] of ports.splice(0).entries()) {
      try {
        others.push(startOther(source, { module, lead: port }, () => lead.post({ mate: number })));
      } catch {
        lead.post({ mate: number });
      }
    }
  };
  const terminate = () => {
    ports.length = 0;
    for (const thread of [lead, ...others]) thread.terminate();
  };
  return { ...lead, terminate };
}

/** onDeath() is also called when it can't start the module. */
function startOther(source, job, onDeath) {
  const thread = startThread(source, { onMessage: ({ type }) => type === 'error' && onDeath(), onDeath });
  thread.hold(false); // the leading one keeps the process alive while it needs others
  thread.post(job, [job.lead]);
  return thread;
}
